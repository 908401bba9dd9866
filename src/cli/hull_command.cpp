// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/hull_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case_io/surface_file.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "figures/hull_picture.hpp"
#include "hull/brute_force_hull.hpp"
#include "hull/chan_hull.hpp"
#include "hull/fast_hull.hpp"
#include "hull/gift_wrapping.hpp"
#include "hull/hybrid_hull.hpp"
#include "hull/merged_faces.hpp"
#include "hull/planar_hull.hpp"
#include "hull/polytope_measures.hpp"
#include "hull/quickhull.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using hull::HullResult;
using hull::HullStatus;
using hull::PlanarAlgorithm;
using json = nlohmann::ordered_json;

struct Arguments {
  fs::path input;
  fs::path out;
  fs::path json_file;
  fs::path svg;
  std::string algorithm = "fast";
  bool merge = false;
};

bool is_planar(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".csv";
}

/// What an algorithm's name stands for in space and in the plane, if there is such a one.
struct NamedAlgorithm {
  const char* name;
  HullResult (*in_space)(std::span<const Vec3>);
  std::optional<PlanarAlgorithm> in_plane;
};

const std::array kAlgorithms{
    NamedAlgorithm{"fast", hull::build_fast_hull, PlanarAlgorithm::Fast},
    NamedAlgorithm{"brute_force",
                   [](std::span<const Vec3> p) { return hull::build_hull_by_brute_force(p); },
                   PlanarAlgorithm::BruteForce},
    NamedAlgorithm{"gift_wrapping",
                   [](std::span<const Vec3> p) { return hull::build_hull_by_gift_wrapping(p); },
                   PlanarAlgorithm::GiftWrapping},
    NamedAlgorithm{"quickhull", [](std::span<const Vec3> p) { return hull::build_convex_hull(p); },
                   PlanarAlgorithm::Quickhull},
    NamedAlgorithm{"graham", nullptr, PlanarAlgorithm::GrahamScan},
    NamedAlgorithm{"chan", [](std::span<const Vec3> p) { return hull::build_hull_by_chan(p); },
                   PlanarAlgorithm::Chan},
    NamedAlgorithm{"hybrid", [](std::span<const Vec3> p) { return hull::build_hull_by_hybrid(p); },
                   PlanarAlgorithm::Hybrid}};

const NamedAlgorithm& algorithm_named(const std::string& name) {
  return *std::find_if(kAlgorithms.begin(), kAlgorithms.end(),
                       [&](const NamedAlgorithm& a) { return a.name == name; });
}

/// Throws where there is no hull, saying why.
void require_hull(HullStatus status, const fs::path& input, std::size_t points) {
  const std::string where = input.string() + ": ";
  switch (status) {
    case HullStatus::Ok:
      return;
    case HullStatus::TooFewPoints:
      throw InvalidInput(where + std::to_string(points) +
                         " points are too few for a hull; four are needed, three in the plane");
    case HullStatus::Collinear:
      throw InvalidInput(where + "all points lie on one line; there is no hull with an inside");
    case HullStatus::Coplanar:
      throw InvalidInput(where + "all points lie in one plane; give them as CSV with two columns");
    case HullStatus::NotFinite:
      throw InvalidInput(where + "a coordinate is not finite; correct the file");
    case HullStatus::ScaleRange:
      throw InvalidInput(where + "a coordinate is beyond 1e100 or nearer to 0 than 1e-100; scale");
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

json statistics_json(const hull::HullStatistics& s) {
  return {{"points_discarded", s.points_discarded},
          {"facets_created", s.facets_created},
          {"orientation_tests", s.orientation_tests},
          {"exact_fallbacks", s.exact_fallbacks}};
}

void print(const json& figures) {
  for (const auto& [key, value] : figures.items()) {
    if (value.is_object()) {
      print(value);
      continue;
    }
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%-18s %s\n", key.c_str(), text.c_str());
  }
}

void report(const Arguments& a, const json& figures) {
  print(figures);
  if (!a.json_file.empty()) records::write_file_atomically(a.json_file, figures.dump(2) + "\n");
}

void run_in_space(const Arguments& a) {
  const NamedAlgorithm& algorithm = algorithm_named(a.algorithm);
  if (algorithm.in_space == nullptr) {
    throw UsageError(a.algorithm + " is an algorithm for the plane; give a CSV file");
  }
  const TriangleMesh object = case_io::read_surface(a.input);
  const auto start = std::chrono::steady_clock::now();
  const HullResult result = algorithm.in_space(object.vertices);
  const double seconds = seconds_since(start);
  require_hull(result.status, a.input, object.vertices.size());
  const std::vector<hull::PolygonalFace> faces = hull::merged_faces(result.polytope);
  if (!a.out.empty() && a.merge) {
    std::vector<std::vector<std::uint32_t>> polygons;
    for (const hull::PolygonalFace& face : faces) polygons.push_back(face.corners);
    records::write_file_atomically(a.out, [&](const fs::path& file) {
      case_io::write_polygons(file, result.polytope.vertices, polygons);
    });
  } else if (!a.out.empty()) {
    records::write_file_atomically(a.out, [&](const fs::path& file) {
      case_io::write_surface(file, result.polytope.surface());
    });
  }
  if (!a.svg.empty())
    records::write_file_atomically(a.svg, figures::draw_hull(object, result.polytope));
  const hull::PolytopeMeasures measures = hull::measures_of(result.polytope);
  report(a, {{"algorithm", a.algorithm},
             {"points", object.vertices.size()},
             {"vertices", result.polytope.vertices.size()},
             {"facets", result.polytope.facets.size()},
             {"faces", faces.size()},
             {"volume_mm3", measures.volume_mm3},
             {"area_mm2", measures.area_mm2},
             {"centroid_mm", {measures.centroid.x, measures.centroid.y, measures.centroid.z}},
             {"seconds", seconds},
             {"statistics", statistics_json(result.statistics)}});
}

void write_corners(const fs::path& file,
                   const std::vector<Vec2>& points,
                   const std::vector<std::uint32_t>& corners) {
  std::string text = "x,y\n";
  for (const std::uint32_t i : corners) {
    std::array<char, 80> line{};
    std::snprintf(line.data(), line.size(), "%.17g,%.17g\n", points[i].x, points[i].y);
    text += line.data();
  }
  records::write_file_atomically(file, text);
}

void run_in_plane(const Arguments& a) {
  if (!a.out.empty() && !is_planar(a.out)) {
    throw UsageError(a.out.string() + ": the hull of points in the plane is written as .csv");
  }
  const std::vector<Vec2> points = case_io::read_planar_points(a.input);
  const auto start = std::chrono::steady_clock::now();
  const hull::PlanarHullResult result =
      hull::build_planar_hull(points, *algorithm_named(a.algorithm).in_plane);
  const double seconds = seconds_since(start);
  require_hull(result.status, a.input, points.size());
  if (!a.out.empty()) write_corners(a.out, points, result.corners);
  if (!a.svg.empty())
    records::write_file_atomically(a.svg, figures::draw_planar_hull(points, result.corners));
  report(a, {{"algorithm", a.algorithm},
             {"points", points.size()},
             {"corners", result.corners},
             {"vertices", result.corners.size()},
             {"seconds", seconds},
             {"statistics", statistics_json(result.statistics)}});
}

}  // namespace

void add_hull_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("hull", "Convex hull of a surface or a set of points");
  command
      ->add_option("input", arguments->input,
                   "Surface or points (.ply .stl .obj .off .xyz), or points in the plane (.csv)")
      ->required();
  std::vector<std::string> names;
  for (const NamedAlgorithm& a : kAlgorithms) names.emplace_back(a.name);
  command
      ->add_option("--algorithm", arguments->algorithm,
                   "In the plane fast is a first filter and graham")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command
      ->add_option("--out", arguments->out,
                   "Write the hull here (.ply .stl .obj .off; in the plane .csv)")
      ->check(output_file());
  command->add_flag("--merge", arguments->merge,
                    "Write coplanar facets as one face (--out .obj or .off)");
  command->add_option("--json", arguments->json_file, "Write the printed figures to this file")
      ->check(output_file());
  command->add_option("--svg", arguments->svg, "Draw the object and its hull")
      ->check(output_file());
  command->callback([arguments] {
    is_planar(arguments->input) ? run_in_plane(*arguments) : run_in_space(*arguments);
  });
}

}  // namespace carpus::cli
