#include "studies/drawing.h"

#include "studies/file.h"

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// The last chunk of a PNG file has a fixed name and checksum.
constexpr std::string_view png_end = "IEND\xAE\x42\x60\x82";
constexpr std::string_view svg_end = "</svg>";

bool is_whole(std::string_view drawing, const fs::path& figure) {
  if (figure.extension() == ".png") return drawing.ends_with(png_end);
  while (drawing.ends_with('\n')) drawing.remove_suffix(1);
  return drawing.ends_with(svg_end);
}

}  // namespace

void keep_drawing(const fs::path& part, const fs::path& figure) {
  const std::string drawing = read_file(part);
  if (!is_whole(drawing, figure)) throw OutputError(figure, "cannot be written: the drawing has no end", 0);
  write_file(figure, drawing);
}

}  // namespace flyball
