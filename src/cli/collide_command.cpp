// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_command.hpp"
#include "cli/output_file.hpp"
#include "survey/methods.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "anatomy/bone_id.hpp"
#include "case_io/surface_file.hpp"
#include "cli/collide_arguments.hpp"
#include "cli/collide_picture.hpp"
#include "cli/collide_report.hpp"
#include "cli/operation_files.hpp"
#include "core/error.hpp"
#include "hull/fast_hull.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using convex::Verdict;
using survey::Method;
using survey::MotionOutcome;
using json = nlohmann::ordered_json;

struct Arguments {
  std::string first;
  std::string second;
  fs::path case_folder;
  std::string method;
  std::string first_pose;
  std::string second_pose;
  std::string sweep;
  fs::path json_file;
  fs::path svg;
};

void list_methods() {
  std::printf("%-20s %-8s %-5s %-24s %s\n", "method", "distance", "depth", "source", "limits");
  for (const Method& m : survey::all_methods()) {
    std::printf("%-20s %-8s %-5s %-24s %s\n", std::string(m.name).c_str(),
                m.gives_distance ? "yes" : "-", m.gives_depth ? "yes" : "-",
                std::string(m.source).c_str(),
                m.limits.empty() ? "none known" : std::string(m.limits).c_str());
  }
}

fs::path surface_of(const Arguments& a, const std::string& name) {
  if (a.case_folder.empty()) {
    if (bone_of(name) && !fs::exists(name)) {
      throw UsageError("'" + name + "' is a bone: say of which case with --case, such as --case " +
                       kDefaultCase);
    }
    return name;
  }
  if (!fs::is_regular_file(a.case_folder / "case.json")) {
    throw IoError(a.case_folder.string() + ": no such case (there is no case.json in it)");
  }
  if (!bone_of(name)) {
    throw UsageError("'" + name + "' is no bone; with --case, name two, such as scaphoid lunate");
  }
  fs::path file = a.case_folder / "bones" / (name + ".ply");
  if (!fs::is_regular_file(file)) {
    throw InvalidInput(a.case_folder.string() + ": the case has no " + name +
                       (name == "scaphoid" ? " in one piece; name scaphoid_proximal or "
                                             "scaphoid_distal"
                                           : ""));
  }
  return file;
}

CollideBody read_body(const Arguments& a, const std::string& name, const Placement& placement) {
  const fs::path file = surface_of(a, name);
  const TriangleMesh surface = case_io::read_surface(file);
  hull::HullResult result = hull::build_fast_hull(surface.vertices);
  switch (result.status) {
    case hull::HullStatus::Ok:
      break;
    case hull::HullStatus::TooFewPoints:
      throw InvalidInput(file.string() + ": " + std::to_string(surface.vertices.size()) +
                         " points are too few for a hull; four are needed");
    case hull::HullStatus::Collinear:
    case hull::HullStatus::Coplanar:
      throw InvalidInput(file.string() +
                         ": all points lie in one plane or on one line; a body "
                         "needs an inside");
    case hull::HullStatus::NotFinite:
      throw InvalidInput(file.string() + ": a coordinate is not finite; correct the file");
    case hull::HullStatus::ScaleRange:
      throw InvalidInput(file.string() +
                         ": a coordinate is beyond 1e100 or nearer to 0 than 1e-100; scale");
  }
  return {a.case_folder.empty() ? fs::path(name).filename().string() : name,
          convex::ConvexBody(std::move(result.polytope)), placement};
}

json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

json json_of(const CollideBody& body) {
  return {{"name", body.name},
          {"vertices", body.hull.vertices().size()},
          {"facets", body.hull.polytope().facets.size()}};
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Apart:
      return "apart";
    case Verdict::Meet:
      return "meet";
    case Verdict::Unknown:
      break;
  }
  return "unknown";
}

const char* name_of(MotionOutcome outcome) {
  switch (outcome) {
    case MotionOutcome::PivotLimit:
      return "pivot_limit";
    case MotionOutcome::NotFinite:
      return "not_finite";
    case MotionOutcome::ScaleRange:
      return "scale_range";
    case MotionOutcome::NeverMeet:
      return "never_meet";
    case MotionOutcome::HasPassed:
      return "has_passed";
    case MotionOutcome::Touching:
      return "touching";
    case MotionOutcome::WillMeet:
      return "will_meet";
  }
  return "unknown";
}

json sweep_json(const CollideReport& report) {
  const survey::ContactInterval& s = report.sweep;
  const bool has_times = s.outcome == MotionOutcome::WillMeet ||
                         s.outcome == MotionOutcome::Touching ||
                         s.outcome == MotionOutcome::HasPassed;
  const bool moves = has_times && std::isfinite(s.t_min_s);
  json result{{"outcome", name_of(s.outcome)},
              {"velocity_mm_per_s", json_of(report.velocity_mm_per_s.value_or(Vec3{}))},
              {"speed_mm_per_s", s.speed_mm_per_s},
              {"t_min_s", nullptr},
              {"t_max_s", nullptr},
              {"distance_to_contact_mm", nullptr},
              {"depth_along_motion_mm", nullptr},
              {"first_contact", nullptr}};
  if (!moves) return result;
  result["t_min_s"] = s.t_min_s;
  result["t_max_s"] = s.t_max_s;
  if (s.outcome == MotionOutcome::WillMeet) result["distance_to_contact_mm"] = s.distance_mm();
  if (s.outcome == MotionOutcome::Touching) {
    result["depth_along_motion_mm"] = s.depth_along_motion_mm();
  }
  result["first_contact"] = {{"point_mm", json_of(s.first.point)},
                             {"normal", json_of(s.first.normal)}};
  return result;
}

json figures_of(const CollideBody& first, const CollideBody& second, const CollideReport& r) {
  json figures{{"first", json_of(first)},       {"second", json_of(second)},
               {"verdict", name_of(r.verdict)}, {"method", r.method->name},
               {"source", r.method->source},    {"limits", r.method->limits},
               {"query_us", r.query_us},        {"distance", nullptr},
               {"penetration", nullptr},        {"sweep", nullptr}};
  if (r.closest) {
    figures["distance"] = {{"method", r.distance_method->name},
                           {"distance_mm", r.closest->distance_mm},
                           {"on_first_mm", json_of(r.closest->on_first)},
                           {"on_second_mm", json_of(r.closest->on_second)},
                           {"normal", json_of(r.closest->normal)}};
  }
  if (r.penetration) {
    figures["penetration"] = {{"method", r.depth_method->name},
                              {"depth_mm", r.penetration->depth_mm},
                              {"direction", json_of(r.penetration->direction)},
                              {"on_first_mm", json_of(r.penetration->on_first)},
                              {"on_second_mm", json_of(r.penetration->on_second)}};
  }
  if (r.velocity_mm_per_s) figures["sweep"] = sweep_json(r);
  return figures;
}

/// For reading: nine significant digits, whatever the size. The JSON file has all.
std::string readable(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_array()) {
    std::string text;
    for (const json& item : value) text += (text.empty() ? "" : ", ") + readable(item);
    return text;
  }
  if (!value.is_number_float()) return value.dump();
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value.get<double>());
  return text.data();
}

void print(const json& figures, const std::string& prefix) {
  for (const auto& [key, value] : figures.items()) {
    if (value.is_null()) continue;
    if (value.is_object()) {
      print(value, prefix + key + ".");
      continue;
    }
    const std::string text = readable(value);
    if (!text.empty()) std::printf("%-32s %s\n", (prefix + key).c_str(), text.c_str());
  }
}

/// Says what a chosen method, or none, could not give.
void print_what_is_missing(const CollideReport& r) {
  const std::string method(r.method->name);
  if (r.verdict == Verdict::Apart && !r.closest) {
    std::printf(
        "%-32s %s\n", "distance",
        r.distance_method == nullptr
            ? (method + " gives no distance; leave out --method, or see --method list").c_str()
            : "not found: the bodies touch up to rounding");
  }
  if (r.verdict == Verdict::Meet && !r.penetration) {
    std::printf("%-32s %s\n", "penetration",
                r.depth_method == nullptr
                    ? (method + " gives no depth; leave out --method, or see --method list").c_str()
                    : "not found: the bodies touch up to rounding");
  }
}

void run(const Arguments& a) {
  if (a.method == "list") {
    list_methods();
    return;
  }
  if (a.second.empty()) {
    throw UsageError("collide: two surfaces are needed, or two bones with --case; see --help");
  }
  const Method* method = a.method.empty() ? nullptr : &method_named(a.method);
  std::optional<Vec3> velocity;
  if (!a.sweep.empty()) velocity = parse_vector("--sweep", a.sweep);
  const Placement first_place = parse_pose("--pose-a", a.first_pose);
  const Placement second_place = parse_pose("--pose-b", a.second_pose);
  const CollideBody first = read_body(a, a.first, first_place);
  const CollideBody second = read_body(a, a.second, second_place);
  const CollideReport report = collide(first, second, method, velocity);
  if (!a.svg.empty()) records::write_file_atomically(a.svg, draw_collision(first, second, report));
  const json figures = figures_of(first, second, report);
  print(figures, "");
  print_what_is_missing(report);
  if (!a.json_file.empty()) records::write_file_atomically(a.json_file, figures.dump(2) + "\n");
  if (report.verdict == Verdict::Unknown) {
    throw InvalidInput(std::string(report.method->name) +
                       " could not tell whether the hulls meet; try another method");
  }
}

}  // namespace

void add_collide_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "collide", "Do the convex hulls of two surfaces meet, how far apart, how deep, and when?");
  command->add_option("first", arguments->first,
                      "Surface or points (.ply .stl .obj .off .xyz), or a bone of --case");
  command->add_option("second", arguments->second, "The other one");
  command->add_option("--case", arguments->case_folder, "Case folder in which the two are bones");
  command->add_option("--method", arguments->method,
                      "Method by its name; list shows all, with their sources and limits");
  command->add_option("--pose-a", arguments->first_pose,
                      "Where the first lies: x,y,z or x,y,z,qw,qx,qy,qz, mm and unit quaternion");
  command->add_option("--pose-b", arguments->second_pose, "Where the second lies, likewise");
  command->add_option(
      "--sweep", arguments->sweep,
      "Velocity vx,vy,vz of the second against the first, mm/s: when do they touch?");
  command->add_option("--json", arguments->json_file, "Write the printed figures to this file")
      ->check(output_file());
  command->add_option("--svg", arguments->svg, "Draw both hulls and what was found")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
