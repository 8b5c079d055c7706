#include "studies/pareto/mopso.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/utils/multi_objective.hpp>
#include <utility>
#include <vector>

namespace flyball {
namespace {

using Numbers = pagmo::vector_double;

// As published.
constexpr double inertia = 0.4, to_own_best = 1.0, to_leader = 1.0, crowd = 10.0;
constexpr int divisions = 10, mutation_power = 5;

struct Point {
  Numbers decision, objectives;
};

bool dominates(const Point& a, const Point& b) { return pagmo::pareto_dominance(a.objectives, b.objectives); }

class Draw {
 public:
  explicit Draw(std::mt19937& random) : random_(random) {}

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double between(double lower, double upper) { return lower + (upper - lower) * unit(); }
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

 private:
  std::mt19937& random_;
};

/// The best points so far, none of which another one dominates, and the cells of objectives that they are in.
class Archive {
 public:
  Archive(std::size_t most, Draw& draw) : most_(most), draw_(draw) {}

  void add(const std::vector<Point>& points) {
    for (const Point& point : points) add(point);
    while (points_.size() > most_) drop_from_fullest_cell();
    if (cells_.empty()) sort_into_cells();
  }

  /// From a cell chosen with a chance of `crowd` over its points, any of them.
  const Point& leader() {
    double total = 0.0;
    for (const auto& [cell, members] : cells_) total += crowd / static_cast<double>(members.size());
    double pointer = draw_.unit() * total;
    for (const auto& [cell, members] : cells_) {
      pointer -= crowd / static_cast<double>(members.size());
      if (pointer <= 0.0) return points_[members[draw_.below(members.size())]];
    }
    return points_.back();
  }

  const std::vector<Point>& points() const { return points_; }

 private:
  void add(const Point& point) {
    const auto beats = [&](const Point& other) {
      return dominates(other, point) || other.objectives == point.objectives;
    };
    if (std::ranges::any_of(points_, beats)) return;
    std::erase_if(points_, [&](const Point& other) { return dominates(point, other); });
    points_.push_back(point);
    cells_.clear();
  }

  void sort_into_cells() {
    cells_.clear();
    const std::size_t objectives = points_.front().objectives.size();
    Numbers lowest = points_.front().objectives, highest = lowest;
    for (const Point& point : points_) {
      for (std::size_t k = 0; k < objectives; ++k) {
        lowest[k] = std::min(lowest[k], point.objectives[k]);
        highest[k] = std::max(highest[k], point.objectives[k]);
      }
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      std::vector<int> cell;
      for (std::size_t k = 0; k < objectives; ++k) {
        const double width = (highest[k] - lowest[k]) / divisions;
        const double at = width > 0.0 ? (points_[i].objectives[k] - lowest[k]) / width : 0.0;
        cell.push_back(std::min(static_cast<int>(at), divisions - 1));
      }
      cells_[cell].push_back(i);
    }
  }

  void drop_from_fullest_cell() {
    sort_into_cells();
    const auto fullest =
        std::ranges::max_element(cells_, {}, [](const auto& cell) { return cell.second.size(); });
    const std::size_t gone = fullest->second[draw_.below(fullest->second.size())];
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(gone));
    cells_.clear();
  }

  std::size_t most_;
  Draw& draw_;
  std::vector<Point> points_;
  std::map<std::vector<int>, std::vector<std::size_t>> cells_;  // numbers of points; empty: not known
};

struct Particle {
  Point now, best;
  Numbers velocity;
};

class Swarm {
 public:
  Swarm(const pagmo::population& from, Draw& draw, const std::shared_ptr<const pagmo::bfe>& batch)
      : problem_(from.get_problem()), draw_(draw), batch_(batch), bounds_(problem_.get_bounds()) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Point point{from.get_x()[i], from.get_f()[i]};
      particles_.push_back({point, point, Numbers(point.decision.size(), 0.0)});
    }
  }

  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const Particle& particle : particles_) all.push_back(particle.now);
    return all;
  }

  /// `mutated` is the part of the swarm that is moved elsewhere, and how far.
  void move(Archive& archive, double mutated) {
    for (Particle& particle : particles_) {
      const Numbers& leader = archive.leader().decision;
      for (std::size_t k = 0; k < leader.size(); ++k) {
        const double x = particle.now.decision[k];
        particle.velocity[k] = inertia * particle.velocity[k] +
                               to_own_best * draw_.unit() * (particle.best.decision[k] - x) +
                               to_leader * draw_.unit() * (leader[k] - x);
        particle.now.decision[k] = x + particle.velocity[k];
      }
      if (draw_.unit() < mutated) mutate(particle.now.decision, mutated);
      reflect(particle);
    }
    evaluate();
    for (Particle& particle : particles_) remember(particle);
  }

 private:
  /// One coordinate, anywhere within the part `mutated` of its range to either side.
  void mutate(Numbers& decision, double mutated) {
    const std::size_t k = draw_.below(decision.size());
    const double reach = mutated * (bounds_.second[k] - bounds_.first[k]);
    decision[k] = draw_.between(std::max(bounds_.first[k], decision[k] - reach),
                                std::min(bounds_.second[k], decision[k] + reach));
  }

  void reflect(Particle& particle) const {
    for (std::size_t k = 0; k < particle.velocity.size(); ++k) {
      const double lower = bounds_.first[k], upper = bounds_.second[k];
      double& x = particle.now.decision[k];
      if (x >= lower && x <= upper) continue;
      x = x < lower ? 2.0 * lower - x : 2.0 * upper - x;
      x = std::clamp(x, lower, upper);
      particle.velocity[k] = -particle.velocity[k];
    }
  }

  void evaluate() {
    if (!batch_) {
      for (Particle& particle : particles_) particle.now.objectives = problem_.fitness(particle.now.decision);
      return;
    }
    Numbers decisions;
    for (const Particle& particle : particles_)
      decisions.insert(decisions.end(), particle.now.decision.begin(), particle.now.decision.end());
    const Numbers fitness = (*batch_)(problem_, decisions);
    auto next = fitness.begin();
    for (Particle& particle : particles_) {
      const auto size = static_cast<std::ptrdiff_t>(particle.now.objectives.size());
      particle.now.objectives.assign(next, next + size);
      next += size;
    }
  }

  void remember(Particle& particle) {
    const bool better = dominates(particle.now, particle.best),
               worse = dominates(particle.best, particle.now);
    if (better || (!worse && draw_.unit() < 0.5)) particle.best = particle.now;
  }

  const pagmo::problem& problem_;
  Draw& draw_;
  const std::shared_ptr<const pagmo::bfe>& batch_;
  std::pair<Numbers, Numbers> bounds_;
  std::vector<Particle> particles_;
};

}  // namespace

Mopso::Mopso(unsigned generations, unsigned seed) : generations_(generations), random_(seed) {}

void Mopso::set_bfe(const pagmo::bfe& batch) { batch_ = std::make_shared<const pagmo::bfe>(batch); }

pagmo::population Mopso::evolve(pagmo::population population) const {
  if (population.size() == 0) return population;
  Draw draw(random_);
  Swarm swarm(population, draw, batch_);
  Archive archive(population.size(), draw);
  archive.add(swarm.points());
  for (unsigned k = 0; k < generations_; ++k) {
    swarm.move(archive, std::pow(1.0 - static_cast<double>(k) / generations_, mutation_power));
    archive.add(swarm.points());
  }
  std::vector<Point> last = archive.points();
  for (const Point& point : swarm.points()) last.push_back(point);
  for (std::size_t i = 0; i < population.size(); ++i)
    population.set_xf(i, last[i].decision, last[i].objectives);
  return population;
}

}  // namespace flyball
