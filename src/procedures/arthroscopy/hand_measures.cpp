// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/arthroscopy/hand_measures.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/bone_words.hpp"
#include "instruments/instrument.hpp"
#include "procedure/thrift_measures.hpp"

namespace carpus::procedures::arthroscopy {
namespace {

using procedure::CartilageScuff;
using procedure::Scuffing;

/// "pressed with up to 9.1 N", "bitten", "shaved", of the worst of one kind.
std::string done_to(Scuffing how, double force_n) {
  switch (how) {
    case Scuffing::Pressed:
      return "pressed with up to " + procedure::text_of(force_n) + " N";
    case Scuffing::Bitten:
      return "bitten";
    case Scuffing::Shaved:
      return "shaved";
  }
  return {};
}

/// "lunate, 2 places, pressed with up to 9.1 N, bitten"; empty where that bone was spared.
std::string of_bone(const cases::CaseData& data,
                    const procedure::ScopeRecord& scope,
                    std::size_t body) {
  std::string ways;
  std::size_t places = 0;
  for (const Scuffing how : {Scuffing::Pressed, Scuffing::Bitten, Scuffing::Shaved}) {
    double most_n = 0;
    std::size_t of_kind = 0;
    for (const CartilageScuff& scuff : scope.scuff_places) {
      if (scuff.body != body || scuff.how != how) continue;
      ++of_kind;
      most_n = std::max(most_n, scuff.force_n);
    }
    if (of_kind > 0) ways += ", " + done_to(how, most_n);
    places += of_kind;
  }
  if (places == 0) return {};
  const cases::Bone& bone = data.bones[body];
  return std::string(words_of(bone.bone, bone.part)) + ", " + std::to_string(places) +
         (places == 1 ? " place" : " places") + ways;
}

}  // namespace

procedure::Measure smoothness(std::string_view id, const procedure::SmoothnessFacts& facts) {
  procedure::Measure measure{id, {}, "It hardly moved in a joint."};
  if (facts.stretches < kLeastStretches) return measure;
  const double log_of_all = std::log(facts.product) + facts.octaves * std::log(2.0);
  measure.value = -log_of_all / facts.stretches;
  measure.finding = "Over " + std::to_string(facts.stretches) + " stretches of " +
                    procedure::text_of(procedure::kStretchMm) + " mm.";
  return measure;
}

procedure::Measure cartilage_scuffs(const cases::CaseData& data,
                                    const procedure::ScopeRecord& scope) {
  procedure::Measure measure{"cartilage_scuffs", {}, "No scope went in."};
  if (scope.entries == 0) return measure;
  measure.value = static_cast<double>(scope.scuffs);
  measure.finding.clear();
  for (std::size_t body = 0; body < data.bones.size(); ++body) {
    const std::string told = of_bone(data, scope, body);
    if (!told.empty()) measure.finding += (measure.finding.empty() ? "On: " : "; ") + told;
  }
  if (!measure.finding.empty()) measure.finding += ".";
  return measure;
}

void tell_scuffs(procedure::ScoreReport& report,
                 const cases::CaseData& data,
                 const procedure::OperationRecord& record) {
  if (!record.scope) return;
  const auto all = instruments::catalogue();
  for (const CartilageScuff& scuff : record.scope->scuff_places) {
    if (scuff.body >= data.bones.size()) continue;
    const cases::Bone& bone = data.bones[scuff.body];
    report.scuffs.push_back(
        {bone.bone, bone.part, scuff.by < all.size() ? all[scuff.by].name : "Instrument", scuff});
  }
}

}  // namespace carpus::procedures::arthroscopy
