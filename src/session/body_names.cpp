// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/body_names.hpp"

#include "anatomy/bone_words.hpp"

namespace carpus::session {

BodyNames::BodyNames(const cases::CaseData& data) {
  for (const cases::Bone& bone : data.bones) {
    bodies_.push_back(
        {std::string(name_of(bone.bone, bone.part)), std::string(words_of(bone.bone, bone.part))});
  }
  for (const cases::Structure& structure : data.structures) structures_.push_back(structure.name);
  if (data.arthroscopy == nullptr) return;
  for (const cases::Portal& portal : data.arthroscopy->portals) portals_.push_back(portal.name);
  for (const cases::TourPoint& point : data.arthroscopy->points) tour_[point.number] = point.name;
}

const std::string& BodyNames::portal(std::size_t index) const noexcept {
  static const std::string kUnknown = "a portal";
  return index < portals_.size() ? portals_[index] : kUnknown;
}

const std::string& BodyNames::tour_point(std::int32_t number) const noexcept {
  static const std::string kUnknown = "a point";
  const auto it = tour_.find(number);
  return it == tour_.end() ? kUnknown : it->second;
}

const std::string& BodyNames::structure(std::size_t index) const noexcept {
  static const std::string kUnknown = "structure";
  return index < structures_.size() ? structures_[index] : kUnknown;
}

const std::string& BodyNames::name(std::size_t body) const noexcept {
  static const std::string kNone;
  return body < bodies_.size() ? bodies_[body].name : kNone;
}

const std::string& BodyNames::words(std::size_t body) const noexcept {
  static const std::string kUnknown = "bone";
  return body < bodies_.size() ? bodies_[body].words : kUnknown;
}

}  // namespace carpus::session
