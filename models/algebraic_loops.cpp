// How algebraic loops are told, and which of them cannot be solved.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "models/order.h"

namespace flyball {
namespace {

constexpr std::size_t most_shown = 24;  // of the outputs and relations of a loop

constexpr const char* what_breaks_it =
    "each of these needs the next one at the same time; an Integrator, a strictly proper TransferFcn or a "
    "UnitDelay anywhere in the chain breaks it";

}  // namespace

/// One way round in the cycle of a node.
std::vector<Endpoint> Order::loop_of(int member) const {
  const auto inside = [&](Endpoint e) { return cycle_[node(e)] == cycle_[member]; };
  Endpoint at = endpoint(member);
  // Every node of a cycle has another one behind it, so walking back must meet itself.
  std::vector<Endpoint> walk;
  std::map<int, std::ptrdiff_t> seen;  // node: where it stands in the walk
  while (seen.emplace(node(at), std::ssize(walk)).second) {
    walk.push_back(at);
    Endpoint before;
    behind(at.instance, diagram_->instances[at.instance].object->reads[at.slot], [&](Endpoint e) {
      if (!before.connected() && inside(e)) before = e;
    });
    at = before;
  }
  walk.erase(walk.begin(), walk.begin() + seen[node(at)]);
  std::ranges::reverse(walk);
  // Begin with the block that stands first in the file.
  const auto first =
      std::ranges::min_element(walk, {}, [&](Endpoint e) { return diagram_->instances[e.instance].at; });
  std::rotate(walk.begin(), first, walk.end());
  return walk;
}

std::string Order::chain_of(const std::vector<Endpoint>& loop) const {
  const auto name = [&](Endpoint e) {
    return fmt::format("{}.{}", diagram_->instances[e.instance].name, spec(e.instance).slots[e.slot].name);
  };
  std::string chain = name(loop.front());
  for (std::size_t k = 1; k <= loop.size(); ++k) {
    if (k == most_shown && loop.size() > most_shown) {
      chain += fmt::format(" -> … ({} more)", loop.size() - most_shown);
      k = loop.size();
    }
    const Endpoint from = loop[k - 1], to = loop[k % loop.size()];
    for (int s = 0; s < static_cast<int>(spec(to.instance).slots.size()); ++s) {
      const bool reads =
          std::ranges::binary_search(diagram_->instances[to.instance].object->reads[to.slot], s);
      if (reads && source_[node(to.instance, s)] == from) {
        chain += fmt::format(" -> {}", name({to.instance, s}));
        break;
      }
    }
    chain += fmt::format(" -> {}", name(to));
  }
  return chain;
}

int Order::behind_port(Endpoint e) const {
  const Endpoint source = source_[node(e)];
  return node(source.connected() ? source : e);
}

void Order::check_guesses(Diagnostics& diagnostics) const {
  for (const Guess& guess : diagram_->guesses) {
    const int node = behind_port(guess.of);
    const auto torn = [&](const Knot& knot) {
      return std::ranges::find(knot.tears, node) != knot.tears.end();
    };
    if (cycle_[node] >= 0 && std::ranges::any_of(cycles_[cycle_[node]].at_hits, torn)) continue;
    const Instance& instance = diagram_->instances[guess.of.instance];
    diagnostics.error(guess.at,
                      fmt::format("{}.{} is in no algebraic loop: there is nothing to guess", instance.name,
                                  spec(guess.of.instance).slots[guess.of.slot].name));
  }
}

void Order::check(const Cycle& cycle, Diagnostics& diagnostics) const {
  const auto unfit = [&](int member) {
    const Endpoint e = endpoint(member);
    return spec(e.instance).slots[e.slot].kind == SlotKind::object_output ||
           !diagram_->instances[e.instance].object->type->differentiable;
  };
  const Position at = diagram_->instances[cycle.begins].at;
  const auto refuse = [&](const std::string& note) {
    diagnostics.error(at, fmt::format("algebraic loop: {}", cycle.chain));
    diagnostics.note(at, note);
  };
  if (diagram_->simulation.refuse_loops) return refuse(what_breaks_it);
  for (const Knot& knot : cycle.at_hits) {
    const auto member = std::ranges::find_if(knot.members, unfit);
    if (member == knot.members.end()) continue;
    const std::string& name = diagram_->instances[endpoint(*member).instance].name;
    return refuse(fmt::format("{} runs once a hit and has no derivative, so this loop cannot be solved; {}",
                              name, what_breaks_it));
  }
}

}  // namespace flyball
