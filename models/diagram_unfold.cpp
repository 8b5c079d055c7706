#include "models/diagram_unfold.h"

#include "models/language/messages.h"

namespace flyball {
namespace {

class Unfolding {
 public:
  explicit Unfolding(ModelBlocks& blocks)
      : blocks_(blocks), used_(blocks.size()), place_(blocks.size(), -1) {}

  void run(Diagram& diagram) {
    // All inputs are resolved before any of them changes: the way leads along the wires as they were drawn.
    std::vector<Endpoint> sources;
    for (int i = 0; i < blocks_.size(); ++i) {
      for (const auto& [slot, source] : blocks_.instances()[i].inputs) sources.push_back(behind(source));
    }
    for (Logged& signal : diagram.logged) signal.source = behind(signal.source);
    for (Guess& guess : diagram.guesses) guess.of = behind(guess.of);
    auto next = sources.begin();
    for (int i = 0; i < blocks_.size(); ++i) {
      for (auto& [slot, source] : blocks_.instances()[i].inputs) source = *next++;
    }
    move_blocks(diagram);
  }

 private:
  bool is_block(int i) const {
    const Role role = blocks_.node(i).role;
    return role == Role::block || (role == Role::fallback && used_[i]);
  }

  void move_blocks(Diagram& diagram) {
    int count = 0;
    for (int i = 0; i < blocks_.size(); ++i) {
      if (is_block(i)) place_[i] = count++;
    }
    const auto move = [&](Endpoint& end) {
      if (end.connected()) end.instance = place_[end.instance];
    };
    diagram.instances.reserve(count);
    for (int i = 0; i < blocks_.size(); ++i) {
      if (place_[i] < 0) continue;
      Instance& instance = diagram.instances.emplace_back(std::move(blocks_.instances()[i]));
      for (auto& [slot, source] : instance.inputs) move(source);
    }
    for (Logged& signal : diagram.logged) move(signal.source);
    for (Guess& guess : diagram.guesses) move(guess.of);
  }

  /// The output of a block that a wire begins at, through all ports on the way.
  Endpoint behind(Endpoint from) {
    for (int hops = 0; from.connected() && !circle_; ++hops) {
      const Node& node = blocks_.node(from.instance);
      if (node.role == Role::fallback) used_[from.instance] = true;
      if (node.role != Role::inside && node.role != Role::outside) return from;
      if (hops > most_hops()) return report_circle(from);
      from = through(from, *node.ports_of, node.role);
    }
    return from;
  }

  /// A slot has the same number on both sides of a port.
  Endpoint through(Endpoint port, const Subsystem& subsystem, Role role) const {
    const int other = role == Role::inside ? subsystem.outside : subsystem.inside;
    Endpoint source;
    if (other >= 0) {
      const int rank = blocks_.form(other)->input_rank[port.slot];
      source = blocks_.instances()[other].inputs[rank].second;
    }
    const int fallback = role == Role::inside ? subsystem.fallback[port.slot] : -1;
    if (source.connected() || fallback < 0) return source;
    return {fallback, blocks_.form(fallback)->specification().port("y")->slots[0]};
  }

  int most_hops() const { return 2 * blocks_.size(); }

  Endpoint report_circle(Endpoint at) {
    const Subsystem& subsystem = *blocks_.node(at.instance).ports_of;
    const Subsystem& user = subsystem.user == nullptr ? subsystem : *subsystem.user;
    const std::string port =
        subsystem.prefix + blocks_.form(at.instance)->specification().slots[at.slot].name;
    user.report.error(blocks_.instances()[at.instance].at, message::ports_in_a_circle(user.local(port)));
    circle_ = true;
    return {};
  }

  ModelBlocks& blocks_;
  std::vector<bool> used_;  // of fallbacks
  std::vector<int> place_;  // in the diagram
  bool circle_ = false;
};

}  // namespace

void unfold(ModelBlocks& blocks, Diagram& diagram) { Unfolding(blocks).run(diagram); }

}  // namespace flyball
