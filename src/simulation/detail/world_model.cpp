// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/world_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "arthroscopy/disc_net.hpp"
#include "core/error.hpp"
#include "haptics/tissue_feel.hpp"
#include "simulation/asked_portals.hpp"
#include "simulation/lesions_of.hpp"

namespace carpus::simulation {

namespace {

constexpr double kSkinMm = 90.0;  // about the first portal, of skin that is worked on

std::vector<fields::ContactField> fields_of(const cases::CaseData& data) {
  std::vector<fields::ContactField> fields;
  fields.reserve(data.bones.size());
  for (const cases::Bone& bone : data.bones) {
    fields.emplace_back(bone.distance_field, bone.surface);
  }
  return fields;
}

std::vector<BoneSolid> target_of(const cases::CaseData& data, BoneId target) {
  std::vector<const MeshIn<frame::Bone>*> fragments;
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone == target) fragments.push_back(&bone.surface);
  }
  std::vector<BoneSolid> solid;
  solid.emplace_back(fragments);
  return solid;
}

}  // namespace

World::Model::Model(const cases::CaseData& case_data,
                    const procedure::Procedure& declared,
                    std::uint64_t first_seed,
                    procedure::Mode way,
                    const std::optional<cases::PreparedPathology>& prepared_wrong)
    : data(case_data),
      procedure(declared),
      seed(first_seed),
      mode(way),
      prepared(declared.examines ? prepared_wrong : std::nullopt),
      kinds(detail::kinds_of(case_data, declared)),
      catalogue(instruments::catalogue()),
      fields(fields_of(case_data)),
      target(target_of(case_data, declared.target)),
      opening(declared.opening(case_data)) {
  for (std::size_t b = 0; b < case_data.bones.size(); ++b) {
    groups[b] = anatomy::group_of(case_data.bones[b].bone);
    Vec3 sum;
    for (const Vec3& v : case_data.bones[b].surface.vertices) sum += v;
    const auto count = static_cast<double>(case_data.bones[b].surface.vertices.size());
    const Vec3 centre = count > 0 ? sum * (1.0 / count) : Vec3{};
    double farthest = 0.0;
    for (const Vec3& v : case_data.bones[b].surface.vertices) {
      farthest = std::max(farthest, squared_length(v - centre));
    }
    centres.push_back(centre);
    reaches_mm.push_back(std::sqrt(farthest));
  }
  fracture = detail::fracture_in(case_data, kinds);
  for (const InstrumentIndex index : declared.tray) {
    has_joint_tools = has_joint_tools || catalogue[index].enters_joints;
  }
  if (has_joint_tools) map = case_data.arthroscopy.get();
  if (declared.making) open_skin();
  if (map != nullptr) lesions = lesions_of(case_data, declared, seed, prepared);
  has_punch = !pieces().empty() && std::any_of(declared.tray.begin(), declared.tray.end(),
                                               [&](instruments::InstrumentIndex index) {
                                                 return catalogue[index].bite.has_value();
                                               });
  cartilage_mm = haptics::feel_table().cartilage.thickness_mm;
  if (lesions) {
    for (std::uint8_t b = 0; b < case_data.bones.size(); ++b) {
      if (squared_length(lesions->shifts[b]) > 0) loose[loose_count++] = b;
    }
    for (std::size_t i = 0; i < lesions->lesions.size() && float_count < floats.size(); ++i) {
      if (lesions->lesions[i].look == cases::LesionLook::Loose) floats[float_count++] = i;
    }
  }
  if (map != nullptr) {
    sheets = detail::yielding_sheets(case_data, *map, lesions ? &*lesions : nullptr);
    yielding::NetState disc;
    disc.reset(sheets[detail::kDiscSheet].net);
    for (const cases::TourPoint& point : map->points) {
      if (point.number == arthroscopy::kHookTestPoint) {
        disc_edge = disc.nearest(sheets[detail::kDiscSheet].net, point.at);
      }
    }
  }
  if (map != nullptr && declared.drill) drill = detail::drill_plan(*declared.drill, *map);
  if (declared.tray.empty() || declared.steps.empty() ||
      declared.steps.size() > procedure::kMaxSteps) {
    throw InvalidInput("simulation: the procedure " + declared.id +
                       " needs a tray and 1 to 32 steps");
  }
}

/// Which portals are made, and the skin that they are made through.
void World::Model::open_skin() {
  map = data.arthroscopy.get();
  if (map == nullptr) return;
  const auto portals = asked_portals(data, *procedure.making, seed);
  if (!portals) return;
  asked = *portals;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const cases::Portal& portal = map->portals[asked[i]];
    const procedure::PortalLandmark* declared =
        procedure::landmark_of(*procedure.making, portal.id);
    if (declared == nullptr) continue;
    for (const cases::FeltLandmark& mark : map->landmarks) {
      if (mark.id == declared->landmark) felt_first[i] = {mark.at, mark.body};
    }
    if (const cases::Portal* other = cases::find_portal(*map, declared->landmark)) {
      felt_first[i] = {other->skin, other->body};
    }
    is_opened_first[i] = declared->is_opened_first;
    for (std::size_t s = 0; s < data.structures.size() && s < cases::kMaxStructures; ++s) {
      const auto& aside = declared->draws_aside;
      const bool is_drawn =
          std::find(aside.begin(), aside.end(), data.structures[s].id) != aside.end();
      if (is_drawn) drawn_aside[i] |= 1U << s;
    }
  }
  skin.emplace(data.skin, map->portals[asked[0]].skin, kSkinMm);
}

}  // namespace carpus::simulation
