// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/lesions_of.hpp"

#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/make_loose_bodies.hpp"
#include "arthroscopy/make_pieces.hpp"
#include "arthroscopy/make_screw.hpp"
#include "arthroscopy/named_grades.hpp"

namespace carpus::simulation {

std::optional<cases::PreparedPathology> pathology_to_begin_with(
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& of_case) {
  if (!procedure.examines) return std::nullopt;
  if (of_case) return of_case;
  return arthroscopy::drawn_pathology(seed, arthroscopy::PathologyTable::generic());
}

std::optional<cases::JointLesions> lesions_of(
    const cases::CaseData& data,
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& prepared) {
  if (data.arthroscopy == nullptr) return std::nullopt;
  const cases::ArthroscopicMap& map = *data.arthroscopy;
  if (procedure.examines) {
    const arthroscopy::PathologyTable& table = arthroscopy::PathologyTable::generic();
    using arthroscopy::Drawn;
    const cases::PreparedPathology wrong =
        prepared ? *prepared
                 : cases::PreparedPathology{
                       arthroscopy::grades_by(seed, table, Drawn::WithoutGrades), seed, true};
    return arthroscopy::make_lesions(data, map, table, wrong.grades, wrong.seed);
  }
  if (procedure.controls_screw) return arthroscopy::make_screw(data, map, seed);
  if (const auto& removal = procedure.removal) {
    return arthroscopy::make_loose_bodies(
        data, map, {removal->bodies, removal->radius_mm, removal->places}, seed);
  }
  if (const auto& shaving = procedure.shaving) {
    if (const auto& synovium = shaving->synovium) {
      return arthroscopy::make_synovitis(
          data, map, {synovium->patches, synovium->tufts, synovium->places}, seed);
    }
    if (const auto& disc = shaving->disc) {
      return arthroscopy::make_torn_disc(data, map, {disc->tears, disc->frayed_mm, disc->rim_mm},
                                         seed);
    }
  }
  return std::nullopt;
}

}  // namespace carpus::simulation
