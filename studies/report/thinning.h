#pragma once

#include "studies/report/html_page.h"

namespace flyball {

/// Rows of a panel that a screen can show: of each of `parts` equal parts of the axis, those in which a curve
/// has its first, last, least and largest value there. A panel with few rows stays as it is.
HtmlFigure::Panel thinned(const HtmlFigure::Panel& panel, int parts);

/// The same for a way: points nearer to the last one than a part of its size are left out.
HtmlPath::Way thinned(const HtmlPath::Way& way, int parts);

}  // namespace flyball
