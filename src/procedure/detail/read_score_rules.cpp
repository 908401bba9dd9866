// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_score_rules.hpp"

#include <cmath>
#include <set>

namespace carpus::procedure::detail {
namespace {

constexpr double kLargest = 1e6;  // of a limit in data

double read_side(const JsonFields& fields, const std::string& field, const nlohmann::json& side) {
  if (!side.is_number() || !(std::abs(side.get<double>()) <= kLargest)) {
    fields.refuse(field + " must be [low, high], each a number or null");
  }
  return side.get<double>();
}

Limits read_limits(JsonFields& fields, const std::string& field) {
  const nlohmann::json& value = fields.value(field);
  if (!value.is_array() || value.size() != 2 || (value[0].is_null() && value[1].is_null())) {
    fields.refuse(field + " must be [low, high], each a number or null, not both null");
  }
  Limits limits;
  if (!value[0].is_null()) limits.low = read_side(fields, field, value[0]);
  if (!value[1].is_null()) limits.high = read_side(fields, field, value[1]);
  if (!(limits.low <= limits.high)) fields.refuse(field + ": low is above high");
  return limits;
}

ScoreRule read_rule(JsonFields& fields) {
  ScoreRule rule;
  rule.id = fields.text("id");
  rule.label = fields.text("label");
  rule.unit = fields.text("unit");
  rule.good = read_limits(fields, "good");
  rule.fail = read_limits(fields, "fail");
  if (rule.fail.low > rule.good.low || rule.fail.high < rule.good.high) {
    fields.refuse("fail lies inside good");
  }
  rule.weight = fields.number("weight", 0, 100);
  rule.why = fields.text("why");
  rule.mark = fields.text("mark");
  fields.refuse_unknown_fields();
  return rule;
}

SafetyRule read_safety(JsonFields& fields) {
  SafetyRule rule;
  rule.id = fields.text("id");
  rule.label = fields.text("label");
  rule.measure = fields.text("measure");
  rule.within = read_limits(fields, "within");
  rule.opens_truth = fields.boolean_or("opens_truth", false);
  rule.mark = fields.text("mark");
  fields.refuse_unknown_fields();
  return rule;
}

}  // namespace

ScoreRules read_score_rules(JsonFields& fields) {
  ScoreRules rules;
  std::set<std::string> ids;
  if (!fields.has("score")) return rules;  // it scores by code of its own
  for (JsonFields& entry : fields.objects("safety")) {
    rules.safety.push_back(read_safety(entry));
    if (!ids.insert(rules.safety.back().id).second) entry.refuse("there are two of this id");
  }
  ids.clear();
  for (JsonFields& entry : fields.objects("score")) {
    rules.items.push_back(read_rule(entry));
    if (!ids.insert(rules.items.back().id).second) entry.refuse("there are two of this id");
  }
  return rules;
}

DeclineRules read_decline_rules(JsonFields& fields) {
  DeclineRules decline;
  if (!fields.has("decline")) return decline;
  JsonFields place = fields.object("decline");
  std::set<std::string> ids;
  for (JsonFields& entry : place.objects("reasons")) {
    decline.reasons.push_back({entry.text("id"), entry.text("label")});
    entry.refuse_unknown_fields();
    if (!ids.insert(decline.reasons.back().id).second) entry.refuse("there are two of this id");
  }
  if (decline.reasons.empty() || decline.reasons.size() > DeclineRules::kMostReasons) {
    place.refuse("reasons: there are " + std::to_string(decline.reasons.size()) +
                 ", must be 1 to " + std::to_string(DeclineRules::kMostReasons));
  }
  decline.rules = read_score_rules(place);
  place.refuse_unknown_fields();
  return decline;
}

}  // namespace carpus::procedure::detail
