#include <fmt/format.h>

#include <filesystem>

#include "models/language/nearest.h"
#include "studies/file.h"
#include "tools/commands.h"
#include "tools/console.h"
#include "tools/json.h"
#include "tools/reference.h"
#include "tools/schema.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

const BlockType& find_block(const std::string& name) {
  if (const BlockType* type = find_block_type(name)) return *type;
  const auto close = nearest(name, block_type_names());
  throw UsageError(fmt::format(
      "there is no block \"{}\"{}", name,
      close ? fmt::format("; did you mean \"{}\"?", *close) : "; flyball blocks lists those that there are"));
}

void write_reference(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "cannot be created", error.value());
  for (const BlockType& type : catalogue()) write_file(folder / (type.name + ".md"), reference_page(type));
  write_file(folder / "index.md", reference_index());
}

}  // namespace

int blocks_command(const BlocksOptions& options) {
  if (!options.markdown.empty()) {
    write_reference(options.markdown);
    print(fmt::format("{}: {} pages and index.md\n", options.markdown, catalogue().size()));
    return exit_done;
  }
  if (options.schema) {
    print(model_schema());
    return exit_done;
  }
  std::vector<const BlockType*> types;
  if (options.name.empty()) {
    for (const BlockType& type : catalogue()) types.push_back(&type);
  } else {
    types.push_back(&find_block(options.name));
  }
  if (options.json) {
    print(blocks_json(types));
  } else {
    print(options.name.empty() ? block_list() : reference_page(*types[0]));
  }
  return exit_done;
}

}  // namespace flyball
