// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/guide_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "arm/delta_arm.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/aabb.hpp"
#include "hardware/workshop/picture.hpp"

namespace carpus::hardware {
namespace {

struct Look {
  bool is_pale = false;
  Vec3 shift;
};
using Choice = std::function<std::optional<Look>(const Piece&)>;

struct Picture {
  std::string name;
  std::function<std::vector<Piece>()> pieces;
  Choice choose;
  /// Names of pieces in the order of their numbers; the first of that name is meant.
  std::vector<std::string> numbered;
  Camera camera;
};

bool is_one_of(const Piece& piece, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), piece.name) != names.end();
}
bool is_board(const Piece& p) {
  return is_one_of(p, {"board", "wrist_shell", "silicone", "portal_frame", "tray", "controller",
                       "mushroom_switch", "switch_box"});
}
bool is_tool(const Piece& p) {
  return p.group == Group::Ring || p.group == Group::Carrier || p.group == Group::Tool;
}
bool is_rod(const Piece& p) { return is_one_of(p, {"tube", "rod_end", "magnet"}); }

/// Printed parts side by side as they come from the bed, in rows.
std::vector<Piece> side_by_side(const Parts& parts,
                                const std::vector<std::pair<std::string, Material>>& rows,
                                double width) {
  std::vector<Piece> pieces;
  double x = 0;
  double y = 0;
  double deepest = 0;
  for (const auto& [name, material] : rows) {
    const TriangleMesh& mesh = parts.at(name);
    const Aabb box = bounds_of(mesh.vertices);
    const Vec3 size = box.extent();
    if (x > 0 && x + size.y > width) {
      x = 0;
      y += deepest + 16;
      deepest = 0;
    }
    pieces.push_back({name, Group::Base, material,
                      moved(mesh, at({y - box.low.x, x - box.low.y, -box.low.z})), -1});
    x += size.y + 16;
    deepest = std::max(deepest, size.x);
  }
  return pieces;
}

/// The jig with a rod and a stud in it.
std::vector<Piece> jig_at_work(const Numbers& n, const Parts& parts) {
  const double half = n["rod"] / 2;
  const double z = 14 + n["ball"] / 2 - 3.5;
  std::vector<Piece> pieces{{"jig", Group::Base, Material::Frame, parts.at("jig"), -1}};
  for (const double side : {-1.0, 1.0}) {
    pieces.push_back(
        {"ball", Group::Base, Material::Steel, moved(ball(5), at({side * half, 0, z})), -1});
    const Place end = along({side * half, 0, z}, {0, 0, z}) * at({0, 0, 4.4});
    pieces.push_back(
        {"rod_end", Group::Rod0, Material::Moving, moved(parts.at("rod_end"), end), -1});
    pieces.push_back(
        {"magnet", Group::Rod0, Material::Steel, moved(ring(3, 6, -0.4, 3.6), end), -1});
    pieces.push_back({"stud_ball", Group::Leg0, Material::Steel,
                      moved(ball(5), at({side * n["half_pair"], -17, z})), -1});
  }
  const Place lying = along({-half, 0, z}, {half, 0, z});
  pieces.push_back({"tube", Group::Rod0, Material::Carbon,
                    moved(ring(2, 3, 9.6, 2 * half - 9.6, 24), lying), -1});
  pieces.push_back({"stud", Group::Leg0, Material::Brass,
                    moved(cylinder(2.5, -18, 18), along({0, -17, z}, {1, -17, z})), -1});
  return pieces;
}

/// A leg held by the gauge and its pin.
std::vector<Piece> gauge_at_work(const Numbers& n, const Parts& parts) {
  AssemblyOptions options;
  std::vector<Piece> pieces;
  // Where the first leg stands at 40 degrees below the horizontal.
  for (double x = -60; x <= 60; x += 0.05) {
    options.tip = {x, 0, -130};
    const auto angles = arm::inverse({}, options.tip);
    if (angles && std::abs((*angles)[0] - radians_from_degrees(40)) < 5e-4) break;
  }
  for (Piece& piece : assemble(n, parts, options)) {
    if ((piece.leg == 0 && !is_rod(piece)) || piece.name == "base_plate")
      pieces.push_back(std::move(piece));
  }
  const Place frame = at({n["offset"] + n["platform_radius"], 0, 0});
  const Place sits{Mat3::from_columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0}), {0, 17, 0}};
  pieces.push_back(
      {"gauge", Group::Fork0, Material::Accent, moved(parts.at("gauge"), frame * sits), 0});
  const double turn = radians_from_degrees(40);
  pieces.push_back({"pin", Group::Fork0, Material::Red,
                    moved(cylinder(1.5, -14, 22),
                          frame * at({60 * std::cos(turn), 0, -60 * std::sin(turn)}) *
                              Place{Mat3::from_columns({-1, 0, 0}, {0, 0, 1}, {0, 1, 0}), {}}),
                    0});
  return pieces;
}

/// Along the leg's axis, for exploded views of the first leg.
Look pulled(double y, double x = 0, double z = 0) { return {false, {x, y, z}}; }

std::vector<Picture> all_pictures(const Numbers& n, const Parts& parts) {
  const auto whole = [&n, &parts](Drive drive, bool is_scope = false, Vec3 tip = {0, 0, -130}) {
    return [&n, &parts, drive, is_scope, tip] {
      AssemblyOptions options;
      options.drive = drive;
      options.is_scope = is_scope;
      options.tip = tip;
      return assemble(n, parts, options);
    };
  };
  const auto everything = [](const Piece&) { return Look{}; };
  Camera seen;
  seen.around_deg = -22;
  seen.above_deg = 20;
  std::vector<Picture> pictures;
  pictures.push_back({"arm_a", whole(Drive::A, false, {12, -14, -138}), everything, {}, seen});
  pictures.push_back({"arm_b", whole(Drive::B, false, {12, -14, -138}), everything, {}, seen});

  Camera above;
  above.around_deg = 0;
  above.above_deg = 52;
  using M = Material;
  const auto lay_out = [&](const char* name, std::vector<std::pair<std::string, Material>> rows,
                           double width) {
    std::vector<std::string> numbered;
    for (const auto& row : rows) numbered.push_back(row.first);
    pictures.push_back({name, [&parts, rows, width] { return side_by_side(parts, rows, width); },
                        everything, numbered, above});
  };
  lay_out("printed_frame",
          {{"base_plate", M::Frame},
           {"post_socket", M::Frame},
           {"post_foot", M::Frame},
           {"bearing_block", M::Frame},
           {"platform", M::Moving},
           {"rod_end", M::Moving},
           {"jig", M::Frame},
           {"gauge", M::Accent},
           {"tray", M::Frame},
           {"switch_box", M::Frame}},
          390);
  lay_out("printed_drives",
          {{"leg_a", M::Moving},
           {"fork", M::Drive},
           {"servo_mount", M::Drive},
           {"pot_mount", M::Drive},
           {"pot_coupler", M::Drive},
           {"leg_b", M::Moving},
           {"drum", M::Accent},
           {"motor_mount", M::Drive},
           {"cradle", M::Red}},
          190);
  // What is tall stands behind.
  lay_out("printed_tool",
          {{"wrist_shell", M::Accent},
           {"scope_grip", M::Accent},
           {"tool_handle", M::Accent},
           {"portal_frame", M::Frame},
           {"gimbal_ring", M::Drive},
           {"carrier", M::Moving},
           {"light_post", M::Accent},
           {"tool_tip", M::Rubber}},
          200);

  Camera jig;
  jig.around_deg = -70;
  jig.above_deg = 38;
  pictures.push_back({"step_01_rods",
                      [&n, &parts] { return jig_at_work(n, parts); },
                      [](const Piece& p) {
                        return Look{p.name == "jig", {}};
                      },
                      {"tube", "rod_end", "magnet", "ball", "stud", "stud_ball"},
                      jig});

  Camera side;
  side.around_deg = 42;
  side.above_deg = 24;
  pictures.push_back({"step_02_bearings",
                      whole(Drive::A),
                      [](const Piece& p) -> std::optional<Look> {
                        if (p.leg != 0 || !is_one_of(p, {"bearing_block", "bearing"}))
                          return std::nullopt;
                        if (p.name == "bearing_block") return Look{};
                        const double y = centroid_of(p.mesh).y;
                        return pulled(y > 20 ? 26 : -26);
                      },
                      {"bearing_block", "bearing"},
                      side});
  pictures.push_back(
      {"step_03_leg_a",
       whole(Drive::A),
       [](const Piece& p) -> std::optional<Look> {
         if (p.leg != 0) return std::nullopt;
         if (is_one_of(p, {"bearing_block", "bearing"})) return Look{true, {}};
         if (is_one_of(p, {"leg_a", "pin_screw"})) return pulled(-50);
         if (p.name == "mast_screw") return pulled(14);
         if (p.name == "shaft") return pulled(-14);
         if (p.group == Group::Leg0 && is_one_of(p, {"stud", "ball", "nut"})) {
           const double y = centroid_of(p.mesh).y;
           return pulled(-50 + (p.name == "stud"
                                    ? -38
                                    : (p.name == "ball" ? (y > 0 ? 12 : -44) : (y > 0 ? 6 : -10))));
         }
         return std::nullopt;
       },
       {"shaft", "leg_a", "stud", "nut", "ball", "pin_screw", "mast_screw"},
       side});
  pictures.push_back(
      {"step_04_drive_a",
       whole(Drive::A),
       [](const Piece& p) -> std::optional<Look> {
         if (p.leg != 0 || is_rod(p) || (p.group == Group::Platform)) return std::nullopt;
         if (p.name == "fork") return pulled(-24);
         if (p.name == "horn") return pulled(-38);
         if (p.name == "servo_mount") return pulled(-58);
         if (p.name == "servo") return pulled(-96);
         if (p.name == "pot_coupler") return pulled(16);
         if (p.name == "pot_mount") return pulled(32);
         if (is_one_of(p, {"potentiometer", "potentiometer_shaft"})) return pulled(58);
         return Look{true, {}};
       },
       {"fork", "horn", "servo_mount", "servo", "pot_coupler", "pot_mount", "potentiometer"},
       side});
  Camera motor = side;
  motor.around_deg = 60;
  pictures.push_back({"step_04_drive_b",
                      whole(Drive::B),
                      [](const Piece& p) -> std::optional<Look> {
                        if (p.leg != 0 || is_rod(p) || (p.group == Group::Platform))
                          return std::nullopt;
                        if (p.name == "cord") return std::nullopt;
                        if (is_one_of(p, {"leg_b", "pin_screw"})) return pulled(-30);
                        if (p.group == Group::Leg0 && is_one_of(p, {"stud", "ball", "nut"}))
                          return pulled(-30);
                        if (p.name == "drum") return pulled(-10, 0, 0);
                        if (p.name == "motor") return pulled(18);
                        if (p.name == "motor_mount") return pulled(36);
                        if (p.name == "encoder") return pulled(56);
                        return Look{true, {}};
                      },
                      {"leg_b", "drum", "motor", "motor_mount", "encoder"},
                      motor});

  Camera plate = seen;
  plate.above_deg = 40;
  plate.around_deg = -50;
  const auto modules = [](const Piece& p) -> std::optional<Look> {
    if (is_rod(p) || is_board(p) || is_tool(p) ||
        is_one_of(p, {"post", "post_socket", "post_foot", "platform"}) ||
        p.group == Group::Platform)
      return std::nullopt;
    if (p.name == "base_plate") return Look{};
    if (p.leg == 0) return Look{false, {34, 0, 26}};
    return Look{p.leg >= 0, {}};
  };
  pictures.push_back(
      {"step_05_plate_a", whole(Drive::A), modules, {"base_plate", "bearing_block"}, plate});
  pictures.push_back(
      {"step_05_plate_b", whole(Drive::B), modules, {"base_plate", "bearing_block"}, plate});

  pictures.push_back(
      {"step_06_stand",
       whole(Drive::A),
       [](const Piece& p) -> std::optional<Look> {
         if (is_rod(p) || is_tool(p) || p.group == Group::Platform) return std::nullopt;
         if (is_one_of(p, {"post", "post_socket", "post_foot", "board", "base_plate"}))
           return Look{};
         if (is_board(p)) return std::nullopt;
         return Look{true, {}};
       },
       {"board", "post_foot", "post", "post_socket"},
       seen});

  Camera gimbal = seen;
  gimbal.around_deg = 40;
  gimbal.above_deg = 30;
  pictures.push_back({"step_07_gimbal",
                      whole(Drive::A),
                      [](const Piece& p) -> std::optional<Look> {
                        if (p.group == Group::Platform) return Look{};
                        if (p.name == "gimbal_ring") return pulled(0, 0, 26);
                        if (p.name == "carrier") return pulled(0, 0, 62);
                        if (p.name == "roll_sensor") return pulled(0, 0, 78);
                        return std::nullopt;
                      },
                      {"platform", "gimbal_ring", "carrier", "roll_sensor", "stud", "ball"},
                      gimbal});
  pictures.push_back({"step_08_hang",
                      whole(Drive::A),
                      [](const Piece& p) -> std::optional<Look> {
                        if (is_one_of(p, {"wrist_shell", "silicone", "portal_frame", "tray",
                                          "controller", "mushroom_switch", "switch_box"}) ||
                            is_tool(p))
                          return std::nullopt;
                        return Look{!(is_rod(p) || p.group == Group::Platform), {}};
                      },
                      {"tube", "platform"},
                      seen});
  Camera low = seen;
  low.above_deg = 14;
  pictures.push_back({"step_09_tool",
                      whole(Drive::A),
                      [](const Piece& p) -> std::optional<Look> {
                        if (p.name == "wrist_shell" || p.name == "silicone" ||
                            p.name == "portal_frame" || is_tool(p))
                          return Look{};
                        return Look{true, {}};
                      },
                      {"carrier", "tool_handle", "tool_shaft", "portal_frame", "wrist_shell"},
                      low});
  pictures.push_back({"step_10_electronics",
                      whole(Drive::A),
                      [](const Piece& p) -> std::optional<Look> {
                        return Look{!is_one_of(p, {"tray", "controller", "mushroom_switch",
                                                   "switch_box", "servo", "potentiometer"}),
                                    {}};
                      },
                      {"tray", "controller", "mushroom_switch", "servo", "potentiometer"},
                      seen});
  Camera pin;
  pin.around_deg = -35;
  pin.above_deg = 18;
  pictures.push_back({"step_11_gauge",
                      [&n, &parts] { return gauge_at_work(n, parts); },
                      [](const Piece& p) {
                        return Look{!is_one_of(p, {"gauge", "pin", "leg_a"}), {}};
                      },
                      {"gauge", "pin", "leg_a"},
                      pin});
  Camera cradle = seen;
  cradle.above_deg = 12;
  pictures.push_back(
      {"step_12_cradle",
       [&n, &parts] {
         AssemblyOptions options;
         options.drive = Drive::B;
         std::vector<Piece> pieces = assemble(n, parts, options);
         pieces.push_back({"cradle", Group::Tool, Material::Red,
                           moved(parts.at("cradle"), at({0, 0, n["portal_z"] + 4.5})), -1});
         return pieces;
       },
       [](const Piece& p) -> std::optional<Look> {
         if (p.leg >= 0 || is_one_of(p, {"base_plate", "post_socket", "post_foot", "post", "board",
                                         "mushroom_switch", "switch_box", "tray", "controller"}))
           return std::nullopt;
         return Look{p.name != "cradle" && p.name != "tool_handle", {}};
       },
       {"tool_handle", "cradle", "portal_frame"},
       cradle});
  Camera scope = seen;
  scope.around_deg = -30;
  scope.above_deg = 16;
  pictures.push_back({"scope",
                      whole(Drive::A, true, {10, -20, -140}),
                      [](const Piece& p) -> std::optional<Look> {
                        if (is_tool(p)) return Look{};
                        if (p.group == Group::Platform ||
                            is_one_of(p, {"wrist_shell", "portal_frame", "silicone"}))
                          return Look{true, {}};
                        return std::nullopt;
                      },
                      {"roll_sensor", "scope_grip", "light_post", "tool_shaft", "wrist_shell"},
                      scope});
  return pictures;
}

void write(const Picture& picture, const std::filesystem::path& folder) {
  const std::vector<Piece> pieces = picture.pieces();
  std::vector<Drawn> drawn;
  for (const Piece& piece : pieces) {
    if (const auto look = picture.choose(piece))
      drawn.push_back({&piece, look->is_pale, look->shift});
  }
  std::vector<Callout> callouts;
  for (const std::string& name : picture.numbered) {
    const auto found = std::find_if(drawn.begin(), drawn.end(),
                                    [&](const Drawn& d) { return d.piece->name == name; });
    if (found == drawn.end())
      throw InvalidInput("guide picture " + picture.name + ": no piece " + name);
    callouts.push_back(
        {static_cast<int>(callouts.size()) + 1, static_cast<std::size_t>(found - drawn.begin())});
  }
  const std::string bytes = draw_picture(drawn, callouts, picture.camera);
  const std::filesystem::path file = folder / (picture.name + ".png");
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw IoError(file.string() + ": cannot be written");
  std::printf("%s %zu bytes\n", file.c_str(), bytes.size());
}

}  // namespace

void draw_guide(const Numbers& numbers,
                const Parts& parts,
                const std::filesystem::path& folder,
                std::span<const char* const> names) {
  std::set<std::string> left(names.begin(), names.end());
  const bool is_all = left.empty();
  std::filesystem::create_directories(folder);
  for (const Picture& picture : all_pictures(numbers, parts)) {
    if (is_all || left.erase(picture.name) > 0) write(picture, folder);
  }
  if (!left.empty()) throw InvalidInput("no picture is called " + *left.begin());
}

}  // namespace carpus::hardware
