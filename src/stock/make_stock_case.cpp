// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "stock/make_stock_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "case_io/case_folder.hpp"
#include "case_io/lesson_file.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "cases/lesson_difficulty.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "instruments/instrument.hpp"
#include "procedures/built_in.hpp"
#include "reconstruct/ground_truth.hpp"
#include "reconstruct/reconstruct_case.hpp"
#include "records/atomic_file.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "stock/case_picture.hpp"
#include "trainee/attempt.hpp"

namespace carpus::stock {
namespace {

namespace fs = std::filesystem;

/// The expert errs too: one of so many tries must do.
constexpr std::uint64_t kTries = 3;
/// Of every bone against the simulated truth.
constexpr double kLeastDice = 0.93;

double smallest_screw_radius_mm() {
  double radius = std::numeric_limits<double>::max();
  for (const instruments::Instrument& each : instruments::catalogue()) {
    if (each.family.empty()) continue;
    radius = std::min(radius, std::max(each.tip_diameter_mm, each.tail_diameter_mm) / 2);
  }
  return radius;
}

double angle_deg(const Mat3& rotation) {
  const double trace = rotation.rows[0].x + rotation.rows[1].y + rotation.rows[2].z;
  return degrees_from_radians(std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)));
}

std::optional<cases::FractureFacts> facts_of(const phantom::Phantom& wrist) {
  if (!wrist.fracture) return std::nullopt;
  const phantom::Fracture& f = *wrist.fracture;
  const auto patient_from_wrist = wrist.wrist_from_patient.inverse();
  const double scale = wrist.options.scale;
  return cases::FractureFacts{(patient_from_wrist * Point<frame::Wrist>{f.point * scale}).v,
                              patient_from_wrist.rotation * f.normal, f.gap_mm * scale,
                              length(f.shift - f.normal * dot(f.shift, f.normal)) * scale,
                              angle_deg(f.rotation)};
}

/// A case whose bones are not those of its wrist would teach something else.
void require_true_bones(const cases::CaseData& data, Grid<std::uint8_t>&& labels) {
  for (const reconstruct::LabelDice& bone :
       reconstruct::compare_labels(data.labels.view(), {std::move(labels)})) {
    if (bone.dice >= kLeastDice) continue;
    throw InvalidInput("stock: the bone with label " + std::to_string(bone.label) +
                       " was reconstructed with Dice " + std::to_string(bone.dice) +
                       ", less than " + std::to_string(kLeastDice) +
                       "; choose another seed or finer voxels");
  }
}

/// The best of the tries by whatever procedure first does it; none where the scripts know none.
std::optional<cases::ExpertProof> prove(const cases::CaseData& data) {
  std::optional<cases::ExpertProof> best;
  for (const procedure::Procedure* procedure : procedures::built_in().all()) {
    for (std::uint64_t seed = 1; seed <= kTries; ++seed) {
      cases::ExpertProof proof{procedure->id, seed, false, 0};
      try {
        const trainee::Attempt attempt =
            trainee::operate(data, *procedure, trainee::Skill::Expert, seed, kProgramVersion);
        proof.is_acceptable = attempt.last.finished && attempt.score.is_fixation_acceptable;
        proof.overall = attempt.score.overall;
      } catch (const InvalidInput&) {
        break;  // it does not know this procedure
      }
      if (!best || proof.overall > best->overall) best = proof;
      if (proof.is_acceptable) return proof;
    }
  }
  return best;
}

cases::CaseData reconstructed(phantom::Phantom&& wrist,
                              const StockItem& item,
                              const std::string& made_at,
                              const Progress& progress) {
  reconstruct::ReconstructOptions options;
  // The title is a diagnosis, and the case's name is on the screen while it is made.
  options.pseudonym = "patient " + std::to_string(item.wrist.seed);
  options.provenance.simulated = true;
  options.provenance.source = "simulated wrist, seed " + std::to_string(item.wrist.seed);
  options.provenance.made_by = "carpus " + std::string(kProgramVersion);
  options.provenance.made_at = made_at;
  options.progress = progress;
  return reconstruct::reconstruct_case(std::move(wrist.ct), options).data;
}

}  // namespace

bool is_made(const fs::path& folder, const StockItem& item) {
  if (!fs::exists(folder / "case.json") || !fs::exists(folder / case_io::kPreviewFile))
    return false;
  try {
    const std::optional<cases::Lesson> lesson = case_io::read_lesson(folder);
    if (!lesson) return false;
    cases::Lesson wanted = item.lesson;
    wanted.difficulty = lesson->difficulty;
    wanted.expert = lesson->expert;
    return *lesson == wanted;
  } catch (const Error&) {
    return false;  // damaged, or of another program: made anew
  }
}

cases::Lesson make_stock_case(const StockItem& item,
                              const fs::path& folder,
                              const std::string& made_at,
                              const Progress& progress) {
  phantom::Phantom wrist = phantom::make_phantom(item.wrist, progress);
  const std::optional<cases::FractureFacts> fracture = facts_of(wrist);
  Grid<std::uint8_t> labels = std::move(wrist.labels);
  cases::CaseData data = reconstructed(std::move(wrist), item, made_at, progress);
  require_true_bones(data, std::move(labels));
  cases::Lesson lesson = item.lesson;
  lesson.difficulty = cases::difficulty_of(data.scaphoid, fracture, smallest_screw_radius_mm());
  progress("soft tissue", 0.0);
  const soft_tissue::SoftTissue tissue = soft_tissue::make_soft_tissue_moving_structures(data);
  case_io::write_case(data, folder, case_io::Overwrite::Replace, progress);
  case_io::write_soft_tissue(tissue, data, folder);
  if (lesson.right_answer != cases::RightAnswer::Decline) {
    progress("scripted expert", 0.0);
    lesson.expert = prove(data);
  }
  progress("picture", 0.9);
  records::write_file_atomically(folder / case_io::kPreviewFile, case_picture(data));
  records::write_file_atomically(folder / case_io::kLessonFile, case_io::lesson_text(lesson));
  progress("done", 1.0);
  return lesson;
}

}  // namespace carpus::stock
