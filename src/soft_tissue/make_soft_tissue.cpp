// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/make_soft_tissue.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "cases/lay_beside.hpp"
#include "cases/make_structures.hpp"
#include "core/parallel.hpp"
#include "soft_tissue/detail/lay_cartilage.hpp"
#include "soft_tissue/detail/lay_disc.hpp"
#include "soft_tissue/detail/lay_ligaments.hpp"
#include "soft_tissue/detail/lay_spaces.hpp"
#include "soft_tissue/overlaps.hpp"

namespace carpus::soft_tissue {
namespace {

using detail::LaidLigament;
using detail::Sheet;
using detail::SheetBody;
using detail::SheetDistance;
using detail::Surroundings;

/// Of a range: what is out by less is printed the same.
constexpr double kRoundingMm = 0.05;
/// What gives way to others over more than the rest lies where another lies, not beside it.
constexpr double kLeastOwnShare = 0.5;

std::string text_of(const char* format, const std::string& name, double a, double b, double c) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, name.c_str(), a, b, c);
  return text.data();
}

bool is_within(double value, const Range& range) {
  return value >= range.low - kRoundingMm && value <= range.high + kRoundingMm;
}

/// Vertices and the middles of facets.
std::vector<Vec3> probes_of(const TriangleMesh& mesh) {
  std::vector<Vec3> probes = mesh.vertices;
  for (const Triangle& t : mesh.facets) {
    probes.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0);
  }
  return probes;
}

/// Of cartilage in other bones than its own.
double deepest_in_others(const Cartilage& c, const Surroundings& bones) {
  double deepest = 0;
  for (const Vec3& p : probes_of(c.body)) {
    for (std::size_t i = 0; i < bones.data().bones.size(); ++i) {
      if (bones.data().bones[i].label == c.label) continue;
      deepest = std::max(deepest, -bones.exact_mm(i, p, 0.01));
    }
  }
  return deepest;
}

class Checks {
 public:
  Checks(SoftTissue& tissue, const Surroundings& bones) : tissue_(tissue), bones_(bones) {}

  void run() {
    for (const Ligament& l : tissue_.ligaments) {
      closed(l.id, l.body);
      if (!is_within(l.length_mm, l.length_range_mm)) {
        note("%s: %.1f mm long, expected %.1f to %.1f", l.id, l.length_mm, l.length_range_mm);
      }
      if (!is_within(l.measured_thickness_mm, l.thickness_range_mm)) {
        note("%s: %.1f mm thick, expected %.1f to %.1f", l.id, l.measured_thickness_mm,
             l.thickness_range_mm);
      }
    }
    if (!tissue_.disc.body.facets.empty()) {
      const Disc& d = tissue_.disc;
      closed("disc", d.body);
      if (!is_within(d.measured_thickness_mm, d.thickness_range_mm)) {
        note("%s: %.1f mm thick, expected %.1f to %.1f", "disc", d.measured_thickness_mm,
             d.thickness_range_mm);
      }
    }
    for (const Cartilage& c : tissue_.cartilage) check(c);
    for (const Space& s : tissue_.spaces) closed(s.name, s.surface);
    measure_depths();
    measure_structures();
    measure_overlaps();
  }

 private:
  void note(const char* format, const std::string& name, double value, const Range& range) {
    tissue_.problems.push_back(text_of(format, name, value, range.low, range.high));
  }

  void closed(const std::string& name, const TriangleMesh& body) {
    if (body.facets.empty()) {
      tissue_.problems.push_back(name + ": could not be made");
    } else if (check_surface(body) != SurfaceStatus::Ok) {
      tissue_.problems.push_back(name + ": its surface is not closed");
    }
  }

  void check(const Cartilage& c) {
    const std::string name = "cartilage of the " + name_of_label(c.label);
    closed(name, c.body);
    if (!is_within(c.mean_thickness_mm, c.thickness_range_mm)) {
      note("%s: %.2f mm thick in the mean, expected %.2f to %.2f", name, c.mean_thickness_mm,
           c.thickness_range_mm);
    }
  }

  std::string name_of_label(std::uint8_t label) const {
    for (const cases::Bone& b : bones_.data().bones) {
      if (b.label == label) return std::string(carpus::name_of(b.bone, b.part));
    }
    return "bone " + std::to_string(label);
  }

  void measure_depths() {
    std::vector<std::pair<std::string, const TriangleMesh*>> bodies;
    for (const Ligament& l : tissue_.ligaments) bodies.emplace_back(l.id, &l.body);
    bodies.emplace_back("disc", &tissue_.disc.body);
    for (const Space& s : tissue_.spaces) bodies.emplace_back(s.name, &s.surface);
    const std::size_t cartilages = tissue_.cartilage.size();
    std::vector<double> deepest(bodies.size() + cartilages);
    parallel_for(deepest.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        deepest[i] = i < bodies.size()
                         ? bones_.deepest_mm(probes_of(*bodies[i].second))
                         : deepest_in_others(tissue_.cartilage[i - bodies.size()], bones_);
      }
    });
    for (std::size_t i = 0; i < deepest.size(); ++i) {
      tissue_.deepest_in_bone_mm = std::max(tissue_.deepest_in_bone_mm, deepest[i]);
      if (deepest[i] <= kDeepestMm) continue;
      const std::string name =
          i < bodies.size()
              ? bodies[i].first
              : "cartilage of the " + name_of_label(tissue_.cartilage[i - bodies.size()].label);
      tissue_.problems.push_back(text_of("%s: %.2f mm in bone", name, deepest[i], 0, 0));
    }
  }

  void measure_structures() {
    const std::vector<cases::Structure>& structures = bones_.data().structures;
    if (structures.empty()) return;
    const std::vector<cases::StructureDepth> depths = cases::structure_depths(bones_.data());
    for (std::size_t i = 0; i < structures.size(); ++i) {
      const auto [in_bone_mm, under_skin_mm] = depths[i];
      const std::string& name = structures[i].name;
      if (in_bone_mm > kDeepestMm) {
        tissue_.problems.push_back(text_of("%s: %.2f mm in bone", name, in_bone_mm, 0, 0));
      }
      if (under_skin_mm < 0) {
        tissue_.problems.push_back(
            text_of("%s: %.2f mm outside the skin", name, -under_skin_mm, 0, 0));
      }
    }
  }

  void measure_overlaps() {
    tissue_.overlaps = overlaps_of(tissue_, bones_.data(), 0);
    for (const Overlap& o : tissue_.overlaps) {
      tissue_.deepest_in_other_mm = std::max(tissue_.deepest_in_other_mm, o.mm);
    }
    std::erase_if(tissue_.overlaps, [](const Overlap& o) { return o.mm <= kDeepestMm; });
    for (const Overlap& o : tissue_.overlaps) {
      tissue_.problems.push_back(
          text_of("%s: %.2f mm in each other", o.first + ", " + o.second, o.mm, 0, 0));
    }
  }

  SoftTissue& tissue_;
  const Surroundings& bones_;
};

/// The bodies of ligaments and disc. Where two would share room one has it: the radioulnar
/// ligaments before the disc whose edges they are, all others after it as they come in the table.
class Bodies {
 public:
  Bodies(const std::vector<LaidLigament>& laid,
         const std::optional<Sheet>& disc,
         const Surroundings& bones)
      : bones_(bones) {
    for (const LaidLigament& l : laid) sheets_.emplace_back(l.sheet);
    for (std::size_t i = 0; i < laid.size(); ++i) {
      if (laid[i].ligament.group == kDiscsEdges) order_.push_back(&sheets_[i]);
    }
    if (disc) {
      disc_.emplace(*disc);
      order_.push_back(&*disc_);
    }
    for (std::size_t i = 0; i < laid.size(); ++i) {
      if (laid[i].ligament.group != kDiscsEdges) order_.push_back(&sheets_[i]);
    }
  }

  [[nodiscard]] SheetBody ligament(std::size_t i) const { return made(sheets_[i]); }
  [[nodiscard]] SheetBody disc() const { return made(*disc_); }
  /// With its edges, which another tissue may face.
  [[nodiscard]] SheetBody whole_disc() const { return detail::body_of(*disc_, {&bones_, {}}); }

 private:
  static constexpr std::string_view kDiscsEdges = "radioulnar";

  [[nodiscard]] SheetBody made(const SheetDistance& sheet) const {
    detail::Kept kept{&bones_, {}};
    for (const SheetDistance* other : order_) {
      if (other == &sheet) break;
      if (other->box().overlaps(sheet.box())) kept.sheets.push_back(other);
    }
    return detail::body_of(sheet, kept);
  }

  const Surroundings& bones_;
  std::vector<SheetDistance> sheets_;
  std::optional<SheetDistance> disc_;
  std::vector<const SheetDistance*> order_;
};

}  // namespace

namespace {

/// All of it, unchecked.
SoftTissue laid_tissue(const Surroundings& bones,
                       const TissueTable& table,
                       const Progress& progress) {
  SoftTissue tissue;
  const detail::CarriedModel model(bones.data());
  tissue.size = model.size();
  tissue.worst_misfit_mm = model.worst_misfit_mm();

  progress("ligaments", 0.1);
  const std::optional<Sheet> disc = detail::lay_disc(table.disc, model, bones, tissue.problems);
  std::vector<LaidLigament> laid = detail::lay_ligaments(table, model, bones, tissue.problems);
  const Bodies bodies(laid, disc, bones);
  std::vector<double> own_shares(laid.size());
  TriangleMesh whole_disc;
  parallel_for(laid.size() + 2, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i >= laid.size()) {
        if (!disc) continue;
        if (i > laid.size()) {
          whole_disc = bodies.whole_disc().body;
          continue;
        }
        SheetBody body = bodies.disc();
        tissue.disc = {disc->middle,
                       std::move(body.body),
                       body.thickness_mm,
                       {table.disc.thickness.range.low * model.size(),
                        table.disc.thickness.range.high * model.size()}};
        continue;
      }
      SheetBody body = bodies.ligament(i);
      laid[i].ligament.body = std::move(body.body);
      laid[i].ligament.measured_thickness_mm = body.thickness_mm;
      own_shares[i] = body.own_share;
    }
  });
  for (std::size_t i = 0; i < laid.size(); ++i) {
    if (own_shares[i] >= kLeastOwnShare) continue;
    tissue.problems.push_back(text_of("%s: %.0f %% of it lies where others lie",
                                      laid[i].ligament.id, 100 * (1 - own_shares[i]), 0, 0));
  }

  progress("cartilage", 0.4);
  std::vector<Sheet> sheets;
  for (const LaidLigament& l : laid) sheets.push_back(l.sheet);
  tissue.cartilage =
      detail::lay_cartilage(table.cartilage, model.size(), bones, whole_disc, sheets);

  progress("joint spaces", 0.6);
  const detail::SpaceInput input{&table,           &model, &bones, &laid, disc ? &*disc : nullptr,
                                 &tissue.cartilage};
  tissue.spaces.resize(table.spaces.size());
  parallel_for(table.spaces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      tissue.spaces[i] = detail::lay_space(table.spaces[i], input);
    }
  });
  for (LaidLigament& l : laid) tissue.ligaments.push_back(std::move(l.ligament));
  return tissue;
}

void check(SoftTissue& tissue, const Surroundings& bones, const Progress& progress) {
  progress("checks", 0.9);
  Checks(tissue, bones).run();
  progress("done", 1.0);
}

/// What a tube must not lie in.
std::vector<const TriangleMesh*> bodies_of(const SoftTissue& tissue) {
  std::vector<const TriangleMesh*> bodies;
  for (const Ligament& l : tissue.ligaments) bodies.push_back(&l.body);
  bodies.push_back(&tissue.disc.body);
  for (const Cartilage& c : tissue.cartilage) bodies.push_back(&c.body);
  return bodies;
}

}  // namespace

SoftTissue make_soft_tissue(const cases::CaseData& data,
                            const TissueTable& table,
                            const Progress& progress) {
  progress("generic wrist", 0);
  const Surroundings bones(data);
  SoftTissue tissue = laid_tissue(bones, table, progress);
  check(tissue, bones, progress);
  return tissue;
}

SoftTissue make_soft_tissue_moving_structures(cases::CaseData& data,
                                              const TissueTable& table,
                                              const Progress& progress) {
  progress("generic wrist", 0);
  const Surroundings bones(data);
  SoftTissue tissue = laid_tissue(bones, table, progress);
  progress("structures beside it", 0.8);
  cases::lay_structures_beside(data, bodies_of(tissue));
  check(tissue, bones, progress);
  return tissue;
}

}  // namespace carpus::soft_tissue
