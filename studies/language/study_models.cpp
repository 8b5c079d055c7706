#include "studies/language/study_models.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "models/diagram_files.h"
#include "models/language/messages.h"
#include "models/read_file.h"
#include "studies/language/model_findings.h"
#include "studies/language/study_messages.h"

namespace flyball {
namespace {

using Kind = TomlValue::Kind;

class ModelReader {
 public:
  ModelReader(const Report& report, Diagnostics& diagnostics) : report_(report), diagnostics_(diagnostics) {}

  std::vector<StudyModel> read(const TomlValue& section) {
    const TomlValue* one = section.find("model");
    const TomlValue* several = section.find("models");
    if (one != nullptr && several != nullptr) {
      report_.error(*several, message::model_and_models());
    } else if (one != nullptr) {
      if (report_.expect(*one, Kind::string, "the name of a model file in quotes")) add(stem(*one), *one);
    } else if (several != nullptr) {
      read_several(*several);
    } else {
      report_.error(section, message::missing_key("model", "[study]"));
    }
    return std::move(models_);
  }

 private:
  static std::string stem(const TomlValue& file) { return std::filesystem::path(file.text).stem().string(); }

  void read_several(const TomlValue& several) {
    if (several.is(Kind::table)) {
      for (const TomlEntry& entry : several.entries) {
        if (report_.expect(entry.value, Kind::string, "the name of a model file in quotes"))
          add(entry.key, entry.value);
      }
    } else if (report_.expect(several, Kind::list, "a list or a table of model files")) {
      for (const TomlValue& item : several.items) {
        if (report_.expect(item, Kind::string, "the name of a model file in quotes")) add(stem(item), item);
      }
    }
    if (several.items.empty() && several.entries.empty()) report_.error(several, message::no_models());
  }

  void add(const std::string& name, const TomlValue& file) {
    if (std::ranges::find(names_, name) != names_.end())
      return report_.error(file, message::model_named_twice(name));
    names_.push_back(name);
    StudyModel model{name, path_beside(report_.file(), file.text), "", nullptr, {}, {}};
    errno = 0;
    const auto text = read_file_content(model.file);
    if (!text) return report_.error(file, message::unreadable_file(model.file, std::strerror(errno)));
    model.text = *text;
    Diagnostics found(model.file);
    if (auto diagram = read_diagram(model.text, found))
      model.plan = make_plan(std::make_shared<const Diagram>(*std::move(diagram)), found);
    take_findings(found, {file.at, name}, diagnostics_);
    if (model.plan) models_.push_back(std::move(model));
  }

  const Report& report_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::vector<StudyModel> models_;
};

}  // namespace

std::vector<StudyModel> read_study_models(const TomlValue& section, const Report& report,
                                          Diagnostics& diagnostics) {
  return ModelReader(report, diagnostics).read(section);
}

}  // namespace flyball
