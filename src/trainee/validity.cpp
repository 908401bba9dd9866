// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/validity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "procedure/grading.hpp"

namespace carpus::trainee {
namespace {

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments_of(std::span<const double> values) {
  Moments m;
  for (const double v : values) m.mean += v;
  m.mean /= static_cast<double>(values.size());
  for (const double v : values) m.variance += (v - m.mean) * (v - m.mean);
  m.variance /= std::max<double>(1.0, static_cast<double>(values.size()) - 1.0);
  return m;
}

/// Share of the rule's points; empty where the case has no such thing.
std::optional<double> share_of(const procedure::ScoreReport& report,
                               const procedure::ScoreRule& rule) {
  for (const procedure::ScoreItem& item : report.items) {
    if (item.id != rule.id) continue;
    return item.value ? procedure::earned_share(rule, *item.value) : 0.0;
  }
  return std::nullopt;
}

void note_missed(CaseMeans& means, const ScoredOperation& one) {
  for (const procedure::MustHave& must : one.score.must_haves) {
    if (must.fulfilled) continue;
    auto found = std::find_if(means.missed.begin(), means.missed.end(),
                              [&](const MissedShare& missed) { return missed.id == must.id; });
    if (found == means.missed.end()) found = means.missed.insert(found, {must.id, {}});
    found->share[static_cast<std::size_t>(one.skill)] += 1.0;
  }
}

/// The procedure's order, which is not that in which they were missed.
void put_in_order(CaseMeans& means, const procedure::Procedure& procedure) {
  std::vector<MissedShare> ordered;
  for (const procedure::SafetyRule& rule : procedure.rules.safety) {
    for (const MissedShare& missed : means.missed) {
      if (missed.id == rule.id) ordered.push_back(missed);
    }
  }
  means.missed = std::move(ordered);
}

}  // namespace

bool CaseMeans::is_in_order() const noexcept {
  const auto of = [&](Skill skill) { return total[static_cast<std::size_t>(skill)]; };
  return of(Skill::Novice) < of(Skill::Middle) && of(Skill::Middle) < of(Skill::Expert);
}

Separation separation_of(std::span<const double> better, std::span<const double> worse) {
  Separation separation;
  double won = 0.0;
  for (const double b : better) {
    for (const double w : worse) won += b > w ? 1.0 : (b == w ? 0.5 : 0.0);
  }
  separation.auc = won / (static_cast<double>(better.size()) * static_cast<double>(worse.size()));
  const Moments b = moments_of(better);
  const Moments w = moments_of(worse);
  const double pooled = std::sqrt(0.5 * (b.variance + w.variance));
  if (pooled > 0.0) separation.effect_size = (b.mean - w.mean) / pooled;
  return separation;
}

ProcedureValidity validity_of(const procedure::Procedure& procedure,
                              std::span<const ScoredOperation> operations,
                              std::size_t cases) {
  ProcedureValidity validity;
  validity.name = procedure.id;
  const auto figures = [&](Skill skill, auto&& figure) {
    std::vector<double> values;
    for (const ScoredOperation& one : operations) {
      if (one.skill != skill) continue;
      if (const std::optional<double> value = figure(one.score)) values.push_back(*value);
    }
    return values;
  };
  const auto separate = [&](auto&& figure) -> std::optional<Separation> {
    const std::vector<double> experts = figures(Skill::Expert, figure);
    const std::vector<double> novices = figures(Skill::Novice, figure);
    if (experts.empty() || novices.empty()) return std::nullopt;
    return separation_of(experts, novices);
  };
  const auto total = [](const procedure::ScoreReport& report) {
    return std::optional<double>(report.overall);
  };
  validity.total = separate(total).value_or(Separation{});
  for (const procedure::ScoreRule& rule : procedure.rules.items) {
    const auto share = [&](const procedure::ScoreReport& report) { return share_of(report, rule); };
    if (const auto separation = separate(share)) {
      validity.items.push_back({rule.id, rule.weight > 0.0, *separation});
    }
  }
  validity.cases.resize(cases);
  for (std::size_t c = 0; c < cases; ++c) {
    std::array<double, kSkillCount> count{};
    std::vector<double> experts;
    std::vector<double> novices;
    CaseMeans& means = validity.cases[c];
    for (const ScoredOperation& one : operations) {
      if (one.case_index != c) continue;
      const auto skill = static_cast<std::size_t>(one.skill);
      if (one.skill == Skill::Expert) experts.push_back(one.score.overall);
      if (one.skill == Skill::Novice) novices.push_back(one.score.overall);
      count[skill] += 1.0;
      means.total[skill] += one.score.overall;
      means.safe_share[skill] += one.score.is_fixation_acceptable ? 1.0 : 0.0;
      note_missed(means, one);
    }
    put_in_order(means, procedure);
    if (!experts.empty() && !novices.empty()) means.separation = separation_of(experts, novices);
    for (std::size_t skill = 0; skill < kSkillCount; ++skill) {
      if (!(count[skill] > 0.0)) continue;
      means.total[skill] /= count[skill];
      means.safe_share[skill] /= count[skill];
      for (MissedShare& missed : means.missed) missed.share[skill] /= count[skill];
    }
  }
  return validity;
}

}  // namespace carpus::trainee
