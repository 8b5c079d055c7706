#pragma once

#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// A declared name: which slot of its block it is. The kinds are types of their own, so that a view can tell
/// at compile time what may be read and written where.
template <int kind>
struct Handle {
  int slot = -1;

  bool declared() const { return slot >= 0; }
  bool operator==(const Handle&) const = default;
};

using Param = Handle<0>;
using Input = Handle<1>;
using Output = Handle<2>;
using State = Handle<3>;
using Held = Handle<4>;
using Relation = Handle<5>;
using Crossing = Handle<6>;
using Alarm = Handle<7>;

/// Consecutive slots: the elements of a vector port, or ports u1, u2, ….
template <class H>
class Many {
 public:
  Many() = default;
  Many(int first, int size) : first_(first), size_(size) {}

  int size() const { return size_; }
  H operator[](int k) const { return H{first_ + k}; }

 private:
  int first_ = -1;
  int size_ = 0;
};

using Inputs = Many<Input>;
using Outputs = Many<Output>;
using States = Many<State>;
using Helds = Many<Held>;
using Relations = Many<Relation>;

/// A position and heading in the plane, as a port with the elements x, y and theta.
template <class H>
struct Pose {
  H x, y, theta;
};

/// A row or table of coefficients, each a parameter. Of a sparse one, an entry written as the literal 0 is
/// absent.
class Coefficients {
 public:
  struct Entry {
    int row, column;
    Param param;
  };

  Coefficients() = default;
  Coefficients(int rows, int columns, std::vector<Entry> entries)
      : rows_(rows), columns_(columns), entries_(std::move(entries)), starts_(rows + 1) {
    for (const Entry& e : entries_) ++starts_[e.row + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  /// The entries that are present, in row-major order.
  const std::vector<Entry>& entries() const { return entries_; }
  /// The entries of row r; none past the last row.
  std::span<const Entry> row(int r) const {
    if (r >= rows_) return {};
    return {entries_.data() + starts_[r], entries_.data() + starts_[r + 1]};
  }
  /// Row r with one parameter a column; those of absent entries are not declared.
  std::vector<Param> params(int r) const {
    std::vector<Param> all(r < rows_ ? columns_ : 0);
    for (const Entry& e : row(r)) all[e.column] = e.param;
    return all;
  }

 private:
  int rows_ = 0;
  int columns_ = 0;
  std::vector<Entry> entries_;
  std::vector<int> starts_{0};  // of each row in `entries_`, and the end
};

/// The sample time of a sampled block, s. Structure: equations may read it, nothing may change it.
using SampleTime = Handle<8>;

/// Ports and memories that hold an object of type O instead of a number.
template <class O>
struct ObjectInput {
  int slot = -1;
};
template <class O>
struct ObjectOutput {
  int slot = -1;
};
template <class O>
struct Memory {
  int slot = -1;
};

}  // namespace flyball
