// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Table 5.1 of [yaacoub2008] anew: the linear program on the hulls' facets against IVRI-CD on all
// vertices, and GLPK and CLP on the same program. Each bone is asked against a neighbour, along a
// course in and out of contact; cold, as a program that is set up and solved each time, and warm.
#include <array>
#include <cstdio>
#include <map>

#include "anatomy/bone_id.hpp"
#include "bench/collision/tables.hpp"
#include "bench/hull/bone_points.hpp"
#include "bench/hull/thesis_tables.hpp"
#include "core/error.hpp"
#include "core/text_format.hpp"
#include "survey/ivri/ivri_cd.hpp"

namespace carpus::bench {
namespace {

constexpr std::size_t kNeighbourVertices = 2500;
constexpr std::size_t kPoses = 40;

/// Printed seconds of table 5.1, in the order of table 4.1, whose bones they are.
struct PrintedTimes {
  BoneId neighbour;  ///< against which it is asked here; the thesis does not say
  double proposed;
  double ivri;
};
constexpr std::array<PrintedTimes, 9> kPrinted{{
    {BoneId::Trapezium, 0.0369, 0.0397},
    {BoneId::Trapezoid, 0.0391, 0.0441},
    {BoneId::Capitate, 0.0411, 0.0521},
    {BoneId::Hamate, 0.0431, 0.0661},
    {BoneId::Triquetrum, 0.0523, 0.0703},
    {BoneId::Radius, 0.0563, 0.0753},
    {BoneId::Radius, 0.0583, 0.0769},
    {BoneId::Scaphoid, 0.0592, 0.0782},
    {BoneId::Lunate, 0.0623, 0.0812},
}};

std::filesystem::path file_of(const std::filesystem::path& folder, BoneId bone) {
  return folder / (std::string(name_of(bone)) + ".ply");
}

/// Nothing else stands for a bone silently.
void check_bones(const std::filesystem::path& folder) {
  check_bones_folder(folder);
  const auto bones = thesis_table_4_1();
  for (std::size_t i = 0; i < bones.size(); ++i) {
    for (const BoneId bone : {bones[i].model, kPrinted[i].neighbour}) {
      if (std::filesystem::exists(file_of(folder, bone))) continue;
      throw IoError(file_of(folder, bone).string() +
                    ": missing, and table 5.1 needs it; leave --bones out for the parametric "
                    "wrist (simulated)");
    }
  }
}

PointSet points_of(const std::filesystem::path& folder, BoneId bone, std::size_t vertices) {
  return folder.empty() ? model_bone(bone, vertices)
                        : thinned_bone(file_of(folder, bone), vertices);
}

std::string known_or_dash(std::size_t count) { return count == 0 ? "-" : std::to_string(count); }

class IvriOnAllVertices final : public convex::PairQuery {
 public:
  IvriOnAllVertices(std::span<const Vec3> first, std::span<const Vec3> second)
      : program_(first, second) {}
  convex::Verdict meets(const convex::PairPose& pose) noexcept override {
    switch (program_.query(pose).status) {
      case survey::IvriStatus::Meet:
        return convex::Verdict::Meet;
      case survey::IvriStatus::Apart:
        return convex::Verdict::Apart;
      default:
        return convex::Verdict::Unknown;
    }
  }
  void forget() noexcept override { program_.forget(); }

 private:
  survey::IvriCd program_;
};

std::vector<PairEngine> engines_for(std::span<const Vec3> first, std::span<const Vec3> second) {
  std::vector<PairEngine> engines;
  for (PairEngine& e : own_pair_engines()) {
    if (e.name.starts_with("lp_") || e.name == "seidel" || e.name == "ivri") {
      engines.push_back(std::move(e));
    }
  }
  engines.push_back({"ivri_all_vertices", false, false, false,
                     [first, second](const convex::ConvexBody&, const convex::ConvexBody&) {
                       return std::make_unique<IvriOnAllVertices>(first, second);
                     }});
  for (PairEngine& peer : peer_lp_engines()) engines.push_back(std::move(peer));
  return engines;
}

}  // namespace

std::vector<CollisionRow> thesis_table(const std::filesystem::path& folder,
                                       const BenchOptions& options) {
  if (!folder.empty()) check_bones(folder);
  std::vector<CollisionRow> rows;
  const auto bones = thesis_table_4_1();
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const ThesisRow& bone = bones[i];
    std::fprintf(stderr, "%.*s\n", static_cast<int>(bone.name.size()), bone.name.data());
    const PointSet own = points_of(folder, bone.model, bone.vertices);
    const PointSet other = points_of(folder, kPrinted[i].neighbour, kNeighbourVertices);
    const auto first = body_of(own.points, own.points.size(), 1);
    const auto second = body_of(other.points, other.points.size(), 1);
    std::vector<PairScript> scripts;
    scripts.push_back(
        {first.get(), second.get(), make_poses("trajectory", *first, *second, kPoses, i + 1)});
    for (const PairEngine& engine : engines_for(own.points, other.points)) {
      if (!options.wants(engine.name)) continue;
      for (const bool cold : {true, false}) {
        CollisionRow row = measure_verdicts(engine, std::string(bone.name) + (cold ? "" : " warm"),
                                            scripts, cold, options);
        row.facets = static_cast<double>(first->polytope().facets.size());
        row.original_vertices = own.points.size();
        row.original_facets = own.origin.surface_facets;
        row.hull_vertices = first->polytope().vertices.size();
        if (engine.name == "lp_scan") row.thesis_seconds = kPrinted[i].proposed;
        if (engine.name == "ivri_all_vertices") row.thesis_seconds = kPrinted[i].ivri;
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::string thesis_text(const std::vector<CollisionRow>& rows) {
  std::map<std::string, std::map<std::string, const CollisionRow*>> table;
  for (const CollisionRow& r : rows) {
    if (r.ran) table[r.pose_case][r.engine] = &r;
  }
  std::string text;
  for (const char* suffix : {"", " warm"}) {
    text += format(
        "\nTable 5.1 anew%s: mean microseconds; the thesis's seconds were of a machine of 2008\n"
        "%-16s %18s %18s %18s %18s %10s %10s %9s %10s %10s %18s %10s\n",
        *suffix == '\0' ? ", cold" : ", warm", "bone", "vertices (thesis)", "facets (thesis)",
        "hull vertices", "hull facets", "lp_scan", "IVRI all", "LP/IVRI", "(thesis)", "best lp", "",
        "GLPK, CLP / it");
    const auto bones = thesis_table_4_1();
    for (std::size_t i = 0; i < bones.size(); ++i) {
      auto& engines = table[std::string(bones[i].name) + suffix];
      const auto mean = [&](const std::string& name) {
        const auto found = engines.find(name);
        return found == engines.end() ? 0.0 : found->second->timing.mean * 1e6;
      };
      const CollisionRow* best = nullptr;
      for (const auto& [name, row] : engines) {
        if (!name.starts_with("lp_") || !row->agrees) continue;
        if (best == nullptr || row->timing.mean < best->timing.mean) best = row;
      }
      const auto any = engines.find("ivri_all_vertices");
      if (best == nullptr || any == engines.end()) continue;
      const double least = best->timing.mean * 1e6;
      text += format(
          "%-16s %9zu (%6zu) %9s (%6zu) %9zu (%6zu) %9.0f (%6zu) %10.2f %10.2f %9.2f %10.2f %10.3f "
          "%-18s %5.0f, %.0f\n",
          std::string(bones[i].name).c_str(), any->second->original_vertices, bones[i].vertices,
          known_or_dash(any->second->original_facets).c_str(), bones[i].facets,
          any->second->hull_vertices, bones[i].hull_vertices, best->facets, bones[i].hull_facets,
          mean("lp_scan"), mean("ivri_all_vertices"), mean("lp_scan") / mean("ivri_all_vertices"),
          kPrinted[i].proposed / kPrinted[i].ivri, least, best->engine.c_str(),
          mean("glpk") / least, mean("clp") / least);
    }
  }
  return text;
}

}  // namespace carpus::bench
