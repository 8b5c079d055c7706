#include "blocks/history.h"

namespace flyball {

void History::add(double t, double u, double forget_before) {
  if (filled_ == 0 || (filled_ == 1 && u != open_.u[0] && t <= open_.begin)) {
    // Nothing was remembered of a segment that is replaced before it has any length.
    const double number = starts_.empty() ? 1.0 : starts_.back().segment + 1.0;
    starts_.push_back({number, t});
    open_.begin = t;
    open_.segment = number;
    open_.u[0] = u;
    filled_ = 1;
    return;
  }
  if (filled_ == 1 && t <= open_.begin) return;
  open_.u[filled_++] = u;
  if (filled_ < points) return;
  open_.end = t;
  // The rows inside this step are asked for after it: they look as far back as from its beginning, give or
  // take rounding.
  const double forgotten = forget_before - (t - open_.begin);
  while (size_ > 1 && (*this)[1].end < forgotten) {
    first_ = (first_ + 1) % ring_.size();
    --size_;
  }
  push(open_);
  const double oldest = (*this)[0].segment;
  starts_.erase(starts_.begin(),
                std::ranges::find_if(starts_, [&](const Start& s) { return s.segment >= oldest; }));
  open_.begin = t;
  open_.u[0] = u;
  filled_ = 1;
}

void History::push(const Piece& piece) {
  if (size_ == ring_.size()) {
    std::vector<Piece> larger(std::max<std::size_t>(64, 2 * size_));
    for (std::size_t k = 0; k < size_; ++k) larger[k] = (*this)[k];
    ring_ = std::move(larger);
    first_ = 0;
  }
  ring_[(first_ + size_++) % ring_.size()] = piece;
}

const History::Piece& History::piece(double time, double segment) const {
  std::size_t low = 0, high = size_ - 1;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const Piece& p = (*this)[middle];
    const bool before = p.segment < segment || (p.segment == segment && p.end < time);
    (before ? low : high) = before ? middle + 1 : middle;
  }
  const Piece& found = (*this)[low];
  return found.segment > segment && low > 0 ? (*this)[low - 1] : found;
}

double History::start(double segment) const {
  const auto found = std::ranges::find(starts_, segment, &Start::segment);
  return found == starts_.end() ? never : found->time;
}

}  // namespace flyball
