#include "tools/profile_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "studies/table.h"

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t rows_shown = 10;

double sum_of(const std::vector<BlockTime>& blocks) {
  double sum = 0.0;
  for (const BlockTime& block : blocks) sum += block.seconds;
  return sum;
}

std::string indented(const std::string& text) {
  std::string result = "  ";
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "  ";
  }
  result.resize(result.size() - 2);
  return result;
}

std::string rest_of(std::size_t all) {
  return all > rows_shown ? fmt::format("  and {} more (--json)\n", all - rows_shown) : "";
}

/// By type, in the order of their longest instances, where equal types come together.
std::vector<std::pair<BlockTime, int>> by_type(const std::vector<BlockTime>& blocks) {
  std::vector<std::pair<BlockTime, int>> types;
  for (const BlockTime& block : blocks) {
    const std::string& name = block.type.empty() ? block.name : block.type;
    auto found = std::ranges::find_if(types, [&](const auto& type) { return type.first.name == name; });
    if (found == types.end()) found = types.insert(types.end(), {{name, block.type}, 0});
    found->first.seconds += block.seconds;
    ++found->second;
  }
  std::ranges::stable_sort(types,
                           [](const auto& a, const auto& b) { return a.first.seconds > b.first.seconds; });
  return types;
}

std::string times_text(const RunResult& result) {
  const Profile& profile = *result.profile;
  const double sum = sum_of(profile.blocks);
  const auto share = [&](double seconds) { return fmt::format("{:.1f} %", 100.0 * seconds / sum); };
  std::string text = fmt::format(
      "\nTime in blocks: {:.3g} ms of {:.3g} ms, an estimate: calls, times the time of a call, measured at "
      "{} points of\n"
      "the run with warm caches. The rest is the method, the location of events, and rows.\n\n",
      1e3 * sum, 1e3 * result.wall_time, profile.points);
  if (profile.blocks.empty()) return text;
  Table types({"block type", "blocks", "share"}), blocks({"block", "type", "share"});
  for (const auto& [type, count] : by_type(profile.blocks))
    types.row({type.name, type.type.empty() ? "" : std::to_string(count), share(type.seconds)});
  for (std::size_t k = 0; k < std::min(rows_shown, profile.blocks.size()); ++k)
    blocks.row({profile.blocks[k].name, profile.blocks[k].type, share(profile.blocks[k].seconds)});
  return text + indented(types.text()) + '\n' + indented(blocks.text()) + rest_of(profile.blocks.size());
}

std::string events_text(const Profile& profile) {
  if (profile.events.empty()) return "\nNo events, alarms or hits.\n";
  Table events({"event", "count"});
  for (std::size_t k = 0; k < std::min(rows_shown, profile.events.size()); ++k)
    events.row({profile.events[k].name, std::to_string(profile.events[k].count)});
  return "\nEvents\n\n" + indented(events.text()) + rest_of(profile.events.size());
}

/// Each tenth of the run.
std::string steps_text(const Profile& profile) {
  Table spans({"from [s]", "steps", "shortest [s]", "longest [s]"});
  const std::size_t together = profile.spans.size() / 10;
  for (std::size_t first = 0; first < profile.spans.size(); first += together) {
    Profile::Span all = profile.spans[first];
    for (std::size_t k = first + 1; k < first + together; ++k) {
      const Profile::Span& span = profile.spans[k];
      if (span.steps == 0) continue;
      all.shortest = all.steps == 0 ? span.shortest : std::min(all.shortest, span.shortest);
      all.longest = std::max(all.longest, span.longest);
      all.steps += span.steps;
    }
    const auto size = [&](double seconds) { return all.steps == 0 ? "" : fmt::format("{:.3g}", seconds); };
    spans.row(
        {fmt::format("{:.6g}", all.begin), std::to_string(all.steps), size(all.shortest), size(all.longest)});
  }
  return "\nSteps\n\n" + indented(spans.text());
}

std::string limits_text(const Profile& profile) {
  std::string text = fmt::format(
      "\nTheir length was set by an instant or the stop time: {}, by max_step: {}, by the method: {}.\n",
      profile.until_instant, profile.at_max_step, profile.by_method);
  if (profile.limiting.empty()) return text;
  Table states({"state with the largest error", "steps"});
  for (std::size_t k = 0; k < std::min(rows_shown, profile.limiting.size()); ++k)
    states.row({profile.limiting[k].name, std::to_string(profile.limiting[k].count)});
  return text + '\n' + indented(states.text()) + rest_of(profile.limiting.size());
}

Json counts_json(const std::vector<Profile::Count>& counts, const char* name, const char* count) {
  Json json = Json::array();
  for (const Profile::Count& c : counts) json.push_back({{name, c.name}, {count, c.count}});
  return json;
}

}  // namespace

std::string profile_text(const RunResult& result) {
  const Profile& profile = *result.profile;
  return times_text(result) + events_text(profile) + steps_text(profile) + limits_text(profile);
}

std::string with_profile(const std::string& metadata, const Profile& profile) {
  Json blocks = Json::array(), spans = Json::array();
  for (const BlockTime& block : profile.blocks)
    blocks.push_back({{"block", block.name}, {"type", block.type}, {"seconds", block.seconds}});
  for (const Profile::Span& span : profile.spans)
    spans.push_back({{"begin", span.begin},
                     {"end", span.end},
                     {"steps", span.steps},
                     {"shortest", span.shortest},
                     {"longest", span.longest}});
  Json json = Json::parse(metadata);
  json.erase("metadata_checksum");  // of a text that this one is not
  json["profile"] = {
      {"evaluations",
       {{"points", profile.points}, {"seconds", sum_of(profile.blocks)}, {"blocks", std::move(blocks)}}},
      {"events", counts_json(profile.events, "event", "count")},
      {"steps",
       {{"spans", std::move(spans)},
        {"until_instant", profile.until_instant},
        {"at_max_step", profile.at_max_step},
        {"by_method", profile.by_method},
        {"limiting", counts_json(profile.limiting, "state", "steps")}}}};
  return json.dump(2) + '\n';
}

}  // namespace flyball
