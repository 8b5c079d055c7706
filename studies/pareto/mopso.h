#pragma once

#include <memory>
#include <random>
#include <string>

namespace pagmo {
class bfe;
class population;
}  // namespace pagmo

namespace flyball {

/// A swarm that follows the points of an archive: Coello, Pulido, Lechuga: Handling multiple objectives with
/// particle swarm optimization, IEEE Transactions on Evolutionary Computation 8(3), 2004. An algorithm of the
/// user, as pagmo calls it; the population that comes out holds the archive first.
///
/// All particles of a generation are evaluated together. The archive has no more points than the swarm; it
/// lies on a grid of objectives that covers it anew after each generation. Leaders come from its emptier
/// cells, and what is too much leaves the fullest one.
class Mopso {
 public:
  explicit Mopso(unsigned generations = 1, unsigned seed = 1);

  pagmo::population evolve(pagmo::population swarm) const;
  void set_seed(unsigned seed) { random_.seed(seed); }
  /// Evaluates whole generations from now on.
  void set_bfe(const pagmo::bfe& batch);
  std::string get_name() const { return "MOPSO: archive-based multi-objective particle swarm"; }

 private:
  unsigned generations_;
  mutable std::mt19937 random_;
  std::shared_ptr<const pagmo::bfe> batch_;
};

}  // namespace flyball
