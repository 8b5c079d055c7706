#pragma once

#include <vector>

namespace flyball {

/// The states inside a step, as a polynomial of at most fourth degree in theta = (t - begin) / taken:
/// x = (1 - theta) start + theta (end + (1 - theta) (first + theta (last + (1 - theta) bubble))).
/// Exact at both ends. A weighted sum of states has the weighted sums of the rows.
///
/// Source: E. Hairer's dopri5.f; without `bubble` it is cubic Hermite interpolation.
template <class T>
struct Extension {
  enum Row { start, end, first, last, bubble, rows };

  T begin, taken;
  const T* data = nullptr;  // the rows, of `size` numbers each
  int size = 0;

  const T* row(Row r) const { return data + r * size; }
  T theta(T t) const { return (t - begin) / taken; }

  void states(T t, T* x) const {
    const T theta = this->theta(t), rest = 1.0 - theta;
    for (int i = 0; i < size; ++i) {
      const T inner = row(last)[i] + rest * row(bubble)[i];
      x[i] = rest * row(start)[i] + theta * (row(end)[i] + rest * (row(first)[i] + theta * inner));
    }
  }
};

/// Fills the inner rows of a cubic Hermite extension from the rates at both ends.
template <class T>
void fill_hermite(const T& taken, const T* rate_before, const T* rate_after, T* rows, int size) {
  using Row = typename Extension<T>::Row;
  const T *start = rows + Row::start * size, *end = rows + Row::end * size;
  T *first = rows + Row::first * size, *last = rows + Row::last * size;
  for (int i = 0; i < size; ++i) {
    const T chord = end[i] - start[i];
    first[i] = taken * rate_before[i] - chord;
    last[i] = chord - taken * rate_after[i] - first[i];
  }
}

}  // namespace flyball
