// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/validity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
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
  // Equal values vary by nothing: not by what their mean is rounded by.
  if (std::ranges::adjacent_find(values, std::ranges::not_equal_to{}) == values.end()) {
    m.variance = 0.0;
  }
  return m;
}

const procedure::ScoreItem* item_of(const procedure::ScoreReport& report, const std::string& id) {
  const auto found = std::ranges::find(report.items, id, &procedure::ScoreItem::id);
  return found == report.items.end() ? nullptr : &*found;
}

/// What the rule's item was worth to those of one skill whose case has it.
struct Earnings {
  std::vector<double> all;       ///< share of the points; 0 where it was not measured
  std::vector<double> measured;  ///< of these where it was
  ItemMeans means;
};

Earnings earnings_of(std::span<const ScoredOperation> operations,
                     Skill skill,
                     const procedure::ScoreRule& rule) {
  Earnings earnings;
  std::vector<double> values;
  for (const ScoredOperation& one : operations) {
    const procedure::ScoreItem* item = one.skill == skill ? item_of(one.score, rule.id) : nullptr;
    if (item == nullptr) continue;
    earnings.all.push_back(item->value ? procedure::earned_share(rule, *item->value) : 0.0);
    if (!item->value) continue;
    earnings.measured.push_back(earnings.all.back());
    values.push_back(*item->value);
  }
  if (earnings.all.empty()) return earnings;
  earnings.means.earned_share = moments_of(earnings.all).mean;
  earnings.means.measured_share =
      static_cast<double>(values.size()) / static_cast<double>(earnings.all.size());
  if (!values.empty()) earnings.means.value = moments_of(values).mean;
  return earnings;
}

/// Empty where experts or novices have no such item.
std::optional<ItemValidity> validity_of(std::span<const ScoredOperation> operations,
                                        const procedure::ScoreRule& rule) {
  const Earnings expert = earnings_of(operations, Skill::Expert, rule);
  const Earnings middle = earnings_of(operations, Skill::Middle, rule);
  const Earnings novice = earnings_of(operations, Skill::Novice, rule);
  if (expert.all.empty() || novice.all.empty()) return std::nullopt;
  ItemValidity item;
  item.id = rule.id;
  item.counted = rule.weight > 0.0;
  item.separation = separation_of(expert.all, novice.all);
  if (!expert.measured.empty() && !novice.measured.empty()) {
    item.where_measured = separation_of(expert.measured, novice.measured);
  }
  item.means[static_cast<std::size_t>(Skill::Expert)] = expert.means;
  item.means[static_cast<std::size_t>(Skill::Middle)] = middle.means;
  item.means[static_cast<std::size_t>(Skill::Novice)] = novice.means;
  return item;
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

bool ItemValidity::is_in_order() const noexcept {
  const auto of = [&](Skill skill) { return means[static_cast<std::size_t>(skill)].earned_share; };
  return of(Skill::Novice) <= of(Skill::Middle) && of(Skill::Middle) <= of(Skill::Expert);
}

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
  const auto totals = [&](Skill skill) {
    std::vector<double> values;
    for (const ScoredOperation& one : operations) {
      if (one.skill == skill) values.push_back(one.score.overall);
    }
    return values;
  };
  const std::vector<double> of_experts = totals(Skill::Expert);
  const std::vector<double> of_novices = totals(Skill::Novice);
  if (!of_experts.empty() && !of_novices.empty()) {
    validity.total = separation_of(of_experts, of_novices);
  }
  for (const procedure::ScoreRule& rule : procedure.rules.items) {
    if (const auto item = validity_of(operations, rule)) validity.items.push_back(*item);
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
