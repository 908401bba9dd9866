// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hardware/workshop/assembly.hpp"

#include <cmath>
#include <utility>

#include "arm/delta_arm.hpp"
#include "case_io/surface_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::hardware {
namespace {

/// A part's x and y are the leg's x and z: its height goes to -y, from `y`; or to +y, and x turns
/// round.
Place flat_side_out(double y) {
  return {Mat3::from_columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0}), {0, y, 0}};
}
Place flat_side_in(double y) {
  return {Mat3::from_columns({-1, 0, 0}, {0, 0, 1}, {0, 1, 0}), {0, y, 0}};
}
/// Something about z lies along the leg's axis.
Place along_axis(double y) { return flat_side_in(y); }
const Place kUpsideDown{Mat3::from_columns({1, 0, 0}, {0, -1, 0}, {0, 0, -1}), {}};

class Builder {
 public:
  Builder(const Numbers& numbers, const Parts& parts, const AssemblyOptions& options)
      : n_(numbers), parts_(parts), o_(options) {
    const auto angles = arm::inverse(arm_, o_.tip);
    if (!angles) throw InvalidInput("assembly: the tip is out of reach");
    angles_ = *angles;
    base_radius_ = n_["offset"] + n_["platform_radius"];
    plate_bottom_ = n_["plate_top"] - n_["plate_thickness"];
  }

  std::vector<Piece> build() {
    base();
    for (leg_ = 0; leg_ < 3; ++leg_) leg(leg_);
    leg_ = -1;
    platform();
    if (o_.has_tool) tool();
    return std::move(pieces_);
  }

 private:
  void add(std::string name,
           Group group,
           Material material,
           const TriangleMesh& mesh,
           const Place& place) {
    pieces_.push_back({std::move(name), group, material, moved(mesh, place), leg_});
  }
  void part(const std::string& name, Group group, Material material, const Place& place) {
    add(name, group, material, parts_.at(name), place);
  }

  void base() {
    const double board = n_["board_top"];
    part("base_plate", Group::Base, Material::Frame, at({0, 0, plate_bottom_}));
    add("board", Group::Base, Material::Wood, box({-215, -180, board - 18}, {205, 180, board}),
        at({}));
    for (int i = 0; i < 3; ++i) {
      const Place out = turned({0, 0, 1}, 60 + 120.0 * i);
      const Vec3 top{n_["post_radius"], 0, plate_bottom_};
      const Vec3 foot{n_["post_foot_radius"], 0, board};
      part("post_socket", Group::Base, Material::Frame,
           out * at({n_["corner_radius"], 0, plate_bottom_}) * kUpsideDown);
      part("post_foot", Group::Base, Material::Frame, out * at(foot) * turned({0, 0, 1}, 180));
      const Vec3 from = top + Vec3{0, 0, -6};
      const Vec3 to = foot + Vec3{0, 0, 6};
      add("post", Group::Base, Material::Steel, ring(6.5, n_["post"] / 2, 0, distance(from, to)),
          out * along(from, to));
    }
    part("wrist_shell", Group::Base, Material::Accent, at({0, 40, board}) * flat_side_out(0));
    add("silicone", Group::Base, Material::Rubber, box({-14, -29, -1.5}, {32, 15, 1.5}),
        at({0, 0, n_["portal_z"]}));
    part("portal_frame", Group::Base, Material::Frame,
         at({0, 0, n_["portal_z"] + 4.5}) * kUpsideDown);
    part("tray", Group::Base, Material::Frame, at({-112, 112, board}));
    add("controller", Group::Base, Material::Board, box({-35, -25, 0}, {35, 25, 1.6}),
        at({-112, 112, board + 9}));
    add("controller", Group::Base, Material::Servo, box({-9, -22, 6}, {9, 22, 9}),
        at({-122, 112, board + 9}));
    part("switch_box", Group::Base, Material::Frame, at({165, -62, board + 34}) * kUpsideDown);
    add("mushroom_switch", Group::Base, Material::Red, cylinder(15, 42, 52), at({165, -62, board}));
    add("mushroom_switch", Group::Base, Material::Steel, cylinder(8, 34, 42),
        at({165, -62, board}));
  }

  void leg(int i) {
    const auto index = static_cast<std::size_t>(i);
    const auto leg = static_cast<Group>(static_cast<int>(Group::Leg0) + i);
    const Place frame = turned({0, 0, 1}, 120.0 * i) * at({base_radius_, 0, 0});
    const double degrees = degrees_from_radians(angles_[index]);
    const Place swung = frame * turned({0, 1, 0}, degrees);
    part("bearing_block", Group::Base, Material::Frame, frame * flat_side_out(33));
    for (const double y : {9.0, 26.0})
      add("bearing", Group::Base, Material::Steel, ring(5.5, 11, 0, 7), frame * along_axis(y));
    add("shaft", leg, Material::Steel, cylinder(4, -6, o_.drive == Drive::A ? 39 : 35),
        swung * along_axis(0));
    if (o_.drive == Drive::A) {
      drive_a(i, frame, swung, degrees);
    } else {
      drive_b(frame, swung, leg);
    }
    cord(leg, frame, swung);
    stud(leg, swung * at({n_["upper_arm"], 0, 0}));
    rods(i, swung);
  }

  /// What carries the leg: from its pin to its bearing block's mast.
  void cord(Group leg, const Place& frame, const Place& swung) {
    const double mast_x = n_["mast_x"];
    const double mast_z = n_["mast_z"];
    add("mast_screw", Group::Base, Material::Steel, cylinder(1.5, 5.5, 34),
        frame * at({mast_x, 0, mast_z}) * along_axis(0));
    add("pin_screw", leg, Material::Steel, cylinder(1.5, -8, 8.4),
        swung * at({n_["spring_on_leg"], 0, 0}) * along_axis(0));
    const Vec3 low = swung * Vec3{n_["spring_on_leg"], 7.5, 0};
    const Vec3 high = frame * Vec3{mast_x, 7.5, mast_z};
    add("cord", leg, Material::Rubber, cylinder(0.8, 0, distance(low, high), 12), along(low, high));
  }

  void drive_a(int i, const Place& frame, const Place& swung, double degrees) {
    const auto leg = static_cast<Group>(static_cast<int>(Group::Leg0) + i);
    const auto fork = static_cast<Group>(static_cast<int>(Group::Fork0) + i);
    part("leg_a", leg, Material::Moving, swung * flat_side_out(6));
    const Place horn = frame * turned({0, 1, 0}, degrees + o_.dog * n_["slot_gap"]);
    part("fork", fork, Material::Drive, horn * flat_side_in(-17.5));
    add("horn", fork, Material::Servo, cylinder(10.5, -2, 0), horn * along_axis(-17.5));
    part("servo_mount", Group::Base, Material::Drive, frame * flat_side_out(-26));
    TriangleMesh servo = box({-10, -10, 0}, {10, 30.4, 37});
    append(servo, box({-10, -17.1, 26}, {10, 37.5, 28.5}));
    append(servo, cylinder(6, 37, 38.6));
    append(servo, cylinder(3, 38.6, 40));
    add("servo", Group::Base, Material::Servo, servo, frame * flat_side_in(-59.5));
    part("pot_mount", Group::Base, Material::Drive, frame * flat_side_in(52));
    part("pot_coupler", leg, Material::Drive, swung * along_axis(33.5));
    TriangleMesh pot = cylinder(11.1, 56, 70);
    append(pot, cylinder(4.7, 46.5, 56));
    add("potentiometer", Group::Base, Material::Brass, pot, frame * along_axis(0));
    add("potentiometer_shaft", leg, Material::Steel, cylinder(3.1, 40.5, 46.4),
        swung * along_axis(0));
  }

  void drive_b(const Place& frame, const Place& swung, Group leg) {
    part("leg_b", leg, Material::Moving, swung * flat_side_out(6));
    part("motor_mount", Group::Base, Material::Drive, frame * flat_side_in(24));
    const double sector = n_["sector_radius"];
    const double away = sector + sector / n_["capstan_ratio"];
    const double angle = radians_from_degrees(n_["drum_angle"]);
    const Place motor = frame * at({away * std::cos(angle), 0, away * std::sin(angle)});
    part("drum", Group::Base, Material::Accent, motor * flat_side_out(10));
    TriangleMesh bell = cylinder(17.3, 10.2, 21, 48);
    append(bell, cylinder(15, 21, 24));
    add("motor", Group::Base, Material::Steel, bell, motor * along_axis(0));
    add("encoder", Group::Base, Material::Board, box({-11, -11, 32}, {11, 11, 33.6}),
        motor * flat_side_in(0) * turned({0, 0, 1}, 45));
  }

  /// An M4 stud along y with a ball at either end and its nuts.
  void stud(Group group, const Place& place) {
    const double half = n_["half_pair"];
    add("stud", group, Material::Steel, cylinder(2, -half + 4, half - 4), place * along_axis(0));
    for (const double side : {-1.0, 1.0}) {
      add("ball", group, Material::Steel, ball(n_["ball"] / 2), place * at({0, side * half, 0}));
      add("nut", group, Material::Steel, cylinder(4.04, 0, 3.2, 6),
          place * along_axis(side > 0 ? 6.1 : -9.3));
    }
  }

  void rods(int i, const Place& swung) {
    const double half = n_["half_pair"];
    const double length = n_["rod"];
    const Place platform = at(o_.tip) * turned({0, 0, 1}, 120.0 * i);
    for (int side = 0; side < 2; ++side) {
      const auto group = static_cast<Group>(static_cast<int>(Group::Rod0) + 2 * i + side);
      const double y = side == 0 ? -half : half;
      const Vec3 from = swung * Vec3{n_["upper_arm"], y, 0};
      const Vec3 to = platform * Vec3{n_["platform_radius"], y, 0};
      if (!(std::abs(distance(from, to) - length) < 1e-6)) {
        throw InvalidInput("assembly: a rod is not as long as numbers.scad says");
      }
      // The ball sits on the inner edge of the magnet.
      const double radius = n_["ball"] / 2;
      const double hole = n_["magnet_hole"] / 2;
      const double face = std::sqrt(radius * radius - hole * hole);
      const double holder = face + n_["magnet_height"] - n_["magnet_recess"];
      const double tube = holder + n_["magnet_recess"] + 2;
      add("tube", group, Material::Carbon, ring(2, 3, tube, length - tube, 24), along(from, to));
      for (const auto& [one, other] : {std::pair{from, to}, std::pair{to, from}}) {
        part("rod_end", group, Material::Moving, along(one, other) * at({0, 0, holder}));
        add("magnet", group, Material::Steel,
            ring(hole, n_["magnet"] / 2, face, face + n_["magnet_height"]), along(one, other));
      }
    }
  }

  void platform() {
    part("platform", Group::Platform, Material::Moving, at(o_.tip + Vec3{0, 0, -6}));
    for (int i = 0; i < 3; ++i) {
      stud(Group::Platform,
           at(o_.tip) * turned({0, 0, 1}, 120.0 * i) * at({n_["platform_radius"], 0, 0}));
    }
  }

  void tool() {
    const arm::PortalTool tool{{0, 0, n_["portal_z"]}, n_["tool_length"]};
    const auto state = arm::portal_state(tool, o_.tip);
    if (!state) throw InvalidInput("assembly: the handle is too near the portal");
    const Place held{arm::tool_rotation(*state, 0), o_.tip};
    part(
        "gimbal_ring", Group::Ring, Material::Drive,
        at(o_.tip) * turned({0, 1, 0}, -degrees_from_radians(state->pitch_rad)) * at({0, 0, -3.5}));
    part("carrier", Group::Carrier, Material::Moving, held * at({0, 0, 25}) * kUpsideDown);
    add("roll_sensor", Group::Carrier, Material::Board, box({-11.5, -11.5, 32}, {11.5, 11.5, 33.6}),
        held);
    add("tool_shaft", Group::Tool, Material::Carbon,
        cylinder(n_["tool_shaft"] / 2, -tool.length_mm + 6, 29.5), held);
    // Or the tool would be pulled down out of the carrier.
    add("retaining_ring", Group::Tool, Material::Steel, ring(3, 6.5, 25.2, 27), held);
    part("tool_tip", Group::Tool, Material::Rubber,
         held * at({0, 0, -tool.length_mm + 14}) * kUpsideDown);
    if (o_.is_scope) {
      part("scope_grip", Group::Carrier, Material::Accent, held * at({0, 0, -26}));
      part("light_post", Group::Tool, Material::Accent, held * at({0, 0, -36}));
    } else {
      part("tool_handle", Group::Tool, Material::Accent, held * at({0, 0, -9}) * kUpsideDown);
    }
  }

  const Numbers& n_;
  const Parts& parts_;
  const AssemblyOptions& o_;
  arm::DeltaArm arm_;
  arm::LegAngles angles_{};
  double base_radius_ = 0;
  double plate_bottom_ = 0;
  int leg_ = -1;
  std::vector<Piece> pieces_;
};

}  // namespace

Parts read_parts(const std::filesystem::path& hardware) {
  Parts parts;
  for (const auto& entry : std::filesystem::directory_iterator(hardware / "stl")) {
    if (entry.path().extension() == ".stl")
      parts[entry.path().stem().string()] = case_io::read_surface(entry.path());
  }
  if (parts.empty()) throw IoError((hardware / "stl").string() + ": no parts");
  return parts;
}

bool tool_may_be_at(const Vec3& tip) {
  const auto state = arm::portal_state({}, tip);
  return state && state->along.z < -std::cos(radians_from_degrees(35));
}

std::vector<Piece> assemble(const Numbers& numbers,
                            const Parts& parts,
                            const AssemblyOptions& options) {
  return Builder(numbers, parts, options).build();
}

}  // namespace carpus::hardware
