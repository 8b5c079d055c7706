#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "studies/language/setting_reader.h"

namespace flyball {

// Each reads one section of a study, if it is there, and reports all that is wrong with it. The order is that
// of use: names of metrics, for one, are known before fits.

/// What the sections are read with, and into.
struct StudyDraft {
  const TomlValue& root;
  const SettingReader& settings;
  Study& study;

  const Report& report() const { return settings.report(); }
  /// The table of a section; nullptr when there is none. What is no table is reported.
  const TomlValue* section(std::string_view name) const;
};

void read_criteria(const StudyDraft& draft);
void read_scenarios(const StudyDraft& draft);
void read_sweep(const StudyDraft& draft);
void read_monte_carlo(const StudyDraft& draft);
void read_fits(const StudyDraft& draft);
void read_fronts(const StudyDraft& draft);
void read_bisections(const StudyDraft& draft);
void read_cases(const StudyDraft& draft);
void read_plots(const StudyDraft& draft);

/// More runs than this are refused.
inline constexpr std::int64_t most_runs = 1'000'000'000;
void check_size(const StudyDraft& draft);

// What sections have in common.

/// The numbers of names in a list of texts; what is no `kind` is reported.
std::vector<int> read_names(const TomlValue& list, std::string_view kind,
                            const std::vector<std::string>& known, const Report& report);
/// The number of a name; -1 where there is none, which is reported.
int read_name(const TomlValue& text, std::string_view kind, const std::vector<std::string>& known,
              const Report& report);
/// One of several words.
void read_word(const TomlValue& table, std::string_view key, const std::vector<std::string>& words,
               std::string& result, const Report& report);
/// A whole number from 1 to `most`.
std::int64_t read_count(const TomlValue& table, std::string_view key, std::int64_t fallback,
                        std::int64_t most, const Report& report);
/// Whether one of these keys has something in its list.
bool lists_something(const TomlValue& table, std::initializer_list<std::string_view> keys);
/// A name that people read, in tables and figures.
bool expect_label(const TomlEntry& entry, const Report& report);

template <class T>
std::vector<std::string> names_of(const std::vector<T>& all) {
  std::vector<std::string> names;
  for (const T& one : all) names.push_back(one.name);
  return names;
}
std::vector<std::string> names_of(const std::vector<std::pair<std::string, std::string>>& all);

}  // namespace flyball
