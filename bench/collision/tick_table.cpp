// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One tick: every bone has moved, every pair is asked. The relative poses are computed before the
// clock starts, for every engine but our own scenes. The broad phase is the same for all: boxes
// that turn with the bones, swept and pruned, inside the time.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/collision/tables.hpp"
#include "bench/stopwatch.hpp"
#include "oracles/exact_meet.hpp"
#include "survey/lp/growth_scene.hpp"
#include "survey/methods.hpp"
#include "survey/scene.hpp"
#include "survey/volumes/sweep_and_prune.hpp"

namespace carpus::bench {
namespace {

using convex::Closest;
using convex::ConvexBody;
using convex::PairPose;
using convex::PairQuery;
using convex::Verdict;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr std::size_t kTicks = 1000;
constexpr std::size_t kTicksWithCachesEmptied = 120;
/// Twice the largest last-level cache of a desktop, and of what the tables were measured on.
constexpr std::size_t kCacheBytes = std::size_t{64} << 20U;

struct Motion {
  std::string name;
  bool jumps = false;
};

/// All bones' poses of all ticks, and the exact verdict of every pair in each.
struct TickScript {
  std::vector<std::vector<PairPose>> bones;     ///< [tick][bone], in the frame of all
  std::vector<std::vector<std::uint8_t>> meet;  ///< [tick][pair]; 2: touching up to rounding
};

PairPose relative(const PairPose& first, const PairPose& second) {
  const Mat3 back = first.rotation.transposed();
  return {back * second.rotation, back * (second.translation - first.translation)};
}

TickScript make_script(const BoneSet& set, const Motion& motion, std::size_t ticks) {
  Rng rng(motion.jumps ? 71 : 70);
  TickScript script;
  std::vector<PairPose> now(set.bones.size());
  for (std::size_t t = 0; t < ticks; ++t) {
    for (std::size_t b = 0; b < now.size(); ++b) {
      const Vec3 home = set.bones[b].body->interior_point();
      if (motion.jumps) {
        constexpr double kJumpMm = 0.5;
        constexpr double kJumpRad = 2 * kDegree;
        const auto c = [&] { return rng.uniform(-kJumpMm, kJumpMm); };
        const double x = c();
        const double y = c();
        now[b] =
            moved({}, home, rotation_about(random_direction(rng), rng.uniform(-kJumpRad, kJumpRad)),
                  {x, y, c()});
        continue;
      }
      const Vec3 centre = now[b].rotation * home + now[b].translation;
      // Every bone takes a whole step each tick, on average towards home, so that none drifts off.
      const Vec3 away = centre - home;
      const Vec3 step = normalized_or(random_direction(rng) - away * 0.3, {1, 0, 0}) * kStepMm;
      now[b] = moved(now[b], centre, rotation_about(random_direction(rng), kStepRad), step);
    }
    script.bones.push_back(now);
  }
  std::vector<oracles::ExactMeet> exact;
  for (std::size_t i = 0; i < set.bones.size(); ++i) {
    for (std::size_t j = i + 1; j < set.bones.size(); ++j) {
      exact.emplace_back(set.bones[i].body->vertices(), set.bones[j].body->vertices());
    }
  }
  for (const auto& bones : script.bones) {
    std::vector<std::uint8_t> row;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      for (std::size_t j = i + 1; j < bones.size(); ++j) {
        const PairPose p = relative(bones[i], bones[j]);
        const auto answer = exact[pair++].query(p.rotation, p.translation);
        row.push_back(answer.needed_integers ? 2 : (answer.meet ? 1 : 0));
      }
    }
    script.meet.push_back(std::move(row));
  }
  return script;
}

/// The box around a body's own box, turned.
Aabb turned_box(const Aabb& box, const PairPose& pose) {
  const Vec3 c = pose.rotation * box.centre() + pose.translation;
  const Vec3 h = box.extent() * 0.5;
  Vec3 reach;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& r = pose.rotation.rows[i];
    reach[i] = std::abs(r.x) * h.x + std::abs(r.y) * h.y + std::abs(r.z) * h.z;
  }
  return {c - reach, c + reach};
}

struct TickSetup {
  bool broad_phase = false;
  bool distance = false;
  bool empty_caches = false;
};

/// Everything of one tick that an engine does.
class TickEngine {
 public:
  TickEngine() = default;
  TickEngine(const TickEngine&) = delete;
  TickEngine& operator=(const TickEngine&) = delete;
  virtual ~TickEngine() = default;
  /// Seconds of one tick.
  virtual double tick(const std::vector<PairPose>& bones) = 0;
  [[nodiscard]] virtual std::span<const Verdict> verdicts() const = 0;
};

/// One PairQuery a pair, behind the boxes of all; relative poses are ready before the clock starts.
class PairsEngine final : public TickEngine {
 public:
  PairsEngine(const BoneSet& set, const PairEngine& engine, TickSetup setup)
      : set_(&set), setup_(setup), sweep_(set.bones.size()), boxes_(set.bones.size()) {
    for (std::size_t i = 0; i < set.bones.size(); ++i) {
      for (std::size_t j = i + 1; j < set.bones.size(); ++j) {
        queries_.push_back(engine.make(*set.bones[i].body, *set.bones[j].body));
      }
    }
    poses_.resize(queries_.size());
    verdicts_.resize(queries_.size());
  }
  double tick(const std::vector<PairPose>& bones) override {
    std::size_t pair = 0;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      for (std::size_t j = i + 1; j < bones.size(); ++j) {
        poses_[pair++] = relative(bones[i], bones[j]);
      }
    }
    const Stopwatch watch;
    if (setup_.broad_phase) {
      for (std::size_t b = 0; b < bones.size(); ++b) {
        boxes_[b] = turned_box(set_->bones[b].body->box(), bones[b]);
      }
      sweep_.update(boxes_);
      std::fill(verdicts_.begin(), verdicts_.end(), Verdict::Apart);
      sweep_.for_each_overlapping(
          [&](survey::IndexPair p) { ask(survey::pair_number(p.first, p.second, bones.size())); });
    } else {
      for (std::size_t p = 0; p < queries_.size(); ++p) ask(p);
    }
    return watch.seconds();
  }
  [[nodiscard]] std::span<const Verdict> verdicts() const override { return verdicts_; }

 private:
  void ask(std::size_t pair) {
    if (setup_.distance) {
      const std::optional<Closest> c = queries_[pair]->closest(poses_[pair]);
      sum_ += c ? c->distance_mm : 0;
      verdicts_[pair] = c ? Verdict::Apart : Verdict::Meet;
    } else {
      verdicts_[pair] = queries_[pair]->meets(poses_[pair]);
    }
  }
  const BoneSet* set_;
  TickSetup setup_;
  survey::SweepAndPrune sweep_;
  std::vector<Aabb> boxes_;
  std::vector<std::unique_ptr<PairQuery>> queries_;
  std::vector<PairPose> poses_;
  std::vector<Verdict> verdicts_;
  double sum_ = 0;
};

std::vector<survey::BodyPose> body_poses(const std::vector<PairPose>& bones) {
  std::vector<survey::BodyPose> poses;
  for (const PairPose& p : bones) poses.push_back({p.rotation, p.translation});
  return poses;
}

/// survey::Scene: poses in the world in, relative poses inside the time.
class SceneEngine final : public TickEngine {
 public:
  SceneEngine(std::span<const ConvexBody> bodies, const survey::Method& method, TickSetup setup)
      : scene_(bodies,
               method,
               setup.broad_phase ? survey::BroadPhase::SweepAndPrune : survey::BroadPhase::None),
        distance_(setup.distance) {}
  double tick(const std::vector<PairPose>& bones) override {
    const auto poses = body_poses(bones);
    const Stopwatch watch;
    if (distance_) {
      scene_.update_distances(poses, 0);
    } else {
      scene_.update(poses);
    }
    return watch.seconds();
  }
  [[nodiscard]] std::span<const Verdict> verdicts() const override { return scene_.verdicts(); }

 private:
  survey::Scene scene_;
  bool distance_;
};

class GrowthSceneEngine final : public TickEngine {
 public:
  GrowthSceneEngine(std::span<const ConvexBody> bodies, bool uses_budget)
      : scene_(pointers(bodies), uses_budget) {}
  double tick(const std::vector<PairPose>& bones) override {
    const auto poses = body_poses(bones);
    const Stopwatch watch;
    scene_.update(poses);
    return watch.seconds();
  }
  [[nodiscard]] std::span<const Verdict> verdicts() const override { return scene_.verdicts(); }

 private:
  static std::vector<const ConvexBody*> pointers(std::span<const ConvexBody> bodies) {
    std::vector<const ConvexBody*> all;
    for (const ConvexBody& b : bodies) all.push_back(&b);
    return all;
  }
  survey::GrowthScene scene_;
};

struct NamedTick {
  std::string name;
  bool is_peer = false;
  std::function<std::unique_ptr<TickEngine>()> make;
};

std::vector<NamedTick> tick_engines(const BoneSet& set,
                                    std::span<const ConvexBody> bodies,
                                    const TickSetup& setup) {
  std::vector<NamedTick> all;
  if (!setup.distance && setup.broad_phase) {
    for (const bool budget : {true, false}) {
      all.push_back({budget ? "growth_scene" : "growth_scene_no_budget", false, [bodies, budget] {
                       return std::make_unique<GrowthSceneEngine>(bodies, budget);
                     }});
    }
  }
  for (const std::string_view name : {"lp_growth", "closest_active_set", "gjk_table"}) {
    const survey::Method* const found = survey::find_method(name);
    if (found == nullptr || (setup.distance && !found->gives_distance)) continue;
    const survey::Method& m = *found;
    all.push_back({"scene:" + std::string(m.name), false, [bodies, &m, setup] {
                     return std::make_unique<SceneEngine>(bodies, m, setup);
                   }});
  }
  std::vector<PairEngine> engines = own_pair_engines();
  for (PairEngine& peer : peer_pair_engines()) engines.push_back(std::move(peer));
  for (const PairEngine& e : engines) {
    if (setup.distance && !e.gives_distance) continue;
    // With caches emptied a tick costs what the flood takes: only what is fast is worth it.
    const bool is_slow = e.name.ends_with("_tree") || e.name.starts_with("quick_cd") ||
                         e.name == "seidel" || e.name == "ivri" || e.name == "fcl_indep";
    if (setup.empty_caches && is_slow) continue;
    all.push_back({e.name, e.is_peer,
                   [&set, e, setup] { return std::make_unique<PairsEngine>(set, e, setup); }});
  }
  return all;
}

/// What reading the clock twice takes.
double clock_overhead() {
  std::vector<double> empty;
  for (int i = 0; i < 501; ++i) {
    const Stopwatch watch;
    empty.push_back(watch.seconds());
  }
  std::nth_element(empty.begin(), empty.begin() + 250, empty.end());
  return empty[250];
}

Timing time_ticks(const NamedTick& engine,
                  const TickScript& script,
                  TickSetup setup,
                  double budget_seconds) {
  const double overhead = clock_overhead();
  std::vector<std::uint64_t> flood(setup.empty_caches ? kCacheBytes / sizeof(std::uint64_t) : 0);
  const std::size_t ticks = setup.empty_caches
                                ? std::min(kTicksWithCachesEmptied, script.bones.size())
                                : script.bones.size();
  std::vector<std::vector<double>> passes;
  Timing counts;
  const Stopwatch watch;
  for (int pass = 0; pass < kPasses && (pass == 0 || watch.seconds() < budget_seconds / 2);
       ++pass) {
    const std::unique_ptr<TickEngine> run = engine.make();
    (void)run->tick(script.bones.front());
    std::vector<double> seconds;
    for (std::size_t t = 1; t < ticks && (t < 10 || watch.seconds() < budget_seconds); ++t) {
      for (std::uint64_t& word : flood) word += 1;
      seconds.push_back(std::max(0.0, run->tick(script.bones[t]) - overhead));
      if (pass != 0) continue;
      for (std::size_t p = 0; p < run->verdicts().size(); ++p) {
        const Verdict v = run->verdicts()[p];
        const std::uint8_t exact = script.meet[t][p];
        if (v == Verdict::Unknown) {
          ++counts.unknown;
        } else if (exact != 2) {
          counts.wrong += (v == Verdict::Meet) != (exact == 1);
        }
      }
    }
    passes.push_back(std::move(seconds));
  }
  std::size_t shortest = passes.front().size();
  for (const auto& p : passes) shortest = std::min(shortest, p.size());
  for (auto& p : passes) p.resize(shortest);
  Timing timing = timing_of(passes);
  timing.wrong = counts.wrong;
  timing.unknown = counts.unknown;
  return timing;
}

}  // namespace

std::vector<CollisionRow> tick_table(const BoneSet& bones, const BenchOptions& options) {
  std::vector<ConvexBody> bodies;
  for (const Bone& b : bones.bones) bodies.push_back(*b.body);
  std::vector<CollisionRow> rows;
  for (const Motion& motion : {Motion{"small", false}, Motion{"jump", true}}) {
    const TickScript script = make_script(bones, motion, kTicks);
    for (const TickSetup setup : {TickSetup{false, false, false}, TickSetup{true, false, false},
                                  TickSetup{true, false, true}, TickSetup{false, true, false},
                                  TickSetup{true, true, false}}) {
      const std::string pose_case = motion.name + (setup.broad_phase ? "_boxes" : "") +
                                    (setup.empty_caches ? "_emptied" : "");
      std::fprintf(stderr, "tick, %s%s\n", pose_case.c_str(), setup.distance ? ", distance" : "");
      for (const NamedTick& engine : tick_engines(bones, bodies, setup)) {
        if (!options.wants(engine.name)) continue;
        CollisionRow row{pose_case,
                         setup.distance ? "tick_distance" : "tick_boolean",
                         engine.name,
                         engine.is_peer,
                         bones.mean_facets(),
                         false,
                         {},
                         false,
                         0};
        const auto timing = run_capped<Timing>(options.caps, [&] {
          return time_ticks(engine, script, setup, options.budget_seconds);
        });
        row.ran = timing.has_value() && timing->queries > 0;
        if (row.ran) {
          row.timing = *timing;
          row.agrees = timing->wrong == 0 && timing->unknown == 0;
        }
        rows.push_back(row);
      }
    }
  }
  return rows;
}

}  // namespace carpus::bench
