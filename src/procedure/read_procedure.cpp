// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Procedures from JSON. Fields: docs/how_to_add_a_procedure.md.
#include <algorithm>
#include <set>

#include "core/json_fields.hpp"
#include "procedure/detail/read_fluid_use.hpp"
#include "procedure/detail/read_loose_removal.hpp"
#include "procedure/detail/read_portal_making.hpp"
#include "procedure/detail/read_scope_drill.hpp"
#include "procedure/detail/read_score_rules.hpp"
#include "procedure/detail/read_shaving.hpp"
#include "procedure/procedure.hpp"

namespace carpus::procedure {
namespace {

using instruments::InstrumentIndex;

constexpr std::string_view kFamily = "family:";

void refuse_unless_snake_case(const JsonFields& fields, const std::string& id) {
  const bool is_snake = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
  if (!is_snake) fields.refuse("id '" + id + "' must be of a to z, 0 to 9 and _");
}

BoneId read_bone(const JsonFields& fields, const std::string& field, const std::string& name) {
  const auto bone = bone_of(name);
  if (!bone || bone->part != BonePart::Whole) fields.refuse(field + ": no bone '" + name + "'");
  return bone->bone;
}

/// One id, or all screws of "family:acutrak_2_mini".
void add_to_tray(const JsonFields& fields,
                 const std::string& entry,
                 std::vector<InstrumentIndex>& tray) {
  const auto all = instruments::catalogue();
  bool found = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_it = entry.starts_with(kFamily)
                           ? all[i].family == std::string_view(entry).substr(kFamily.size())
                           : all[i].id == entry;
    if (!is_it) continue;
    found = true;
    const auto index = static_cast<InstrumentIndex>(i);
    if (std::find(tray.begin(), tray.end(), index) != tray.end()) {
      fields.refuse("tray: '" + entry + "' is on it twice");
    }
    tray.push_back(index);
  }
  if (!found) fields.refuse("tray: no instrument '" + entry + "'");
}

Predicate read_predicate(JsonFields& fields,
                         const std::string& field,
                         std::span<const NamedPredicate> predicates) {
  const std::string name = fields.text(field);
  std::string known;
  for (const NamedPredicate& each : predicates) {
    if (each.name == name) return each.predicate;
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  fields.refuse(field + ": no predicate '" + name + "' among those given: " + known);
}

Step read_step(JsonFields& fields,
               std::span<const NamedPredicate> predicates,
               const std::vector<InstrumentIndex>& tray) {
  Step step;
  step.id = fields.text("id");
  refuse_unless_snake_case(fields, step.id);
  step.title = fields.text("title");
  step.instruction = fields.text("instruction");
  step.actions = fields.texts_or_none("actions");
  if (fields.has("instrument")) {
    const std::string id = fields.text("instrument");
    const auto index = instruments::instrument_of(id);
    if (!index || std::find(tray.begin(), tray.end(), *index) == tray.end()) {
      fields.refuse("instrument: '" + id + "' is not on the tray");
    }
    step.instrument = *index;
  }
  step.is_done = read_predicate(fields, "done", predicates);
  if (fields.has("lost")) step.is_lost = read_predicate(fields, "lost", predicates);
  step.passes_over_earlier = fields.boolean_or("passes_over_earlier", false);
  fields.refuse_unknown_fields();
  return step;
}

NamedView read_view(JsonFields& fields) {
  NamedView view;
  view.id = fields.text("id");
  refuse_unless_snake_case(fields, view.id);
  view.label = fields.text("label");
  view.rotation_deg = fields.number("rotation_deg", -180, 180);
  view.tilt_deg = fields.number("tilt_deg", -60, 60);
  if (fields.has("flexion_deg")) view.flexion_deg = fields.number("flexion_deg", -90, 90);
  if (fields.has("radial_deviation_deg")) {
    view.radial_deviation_deg = fields.number("radial_deviation_deg", -60, 60);
  }
  fields.refuse_unknown_fields();
  return view;
}

template <typename T>
void refuse_twins(const JsonFields& fields, const std::string& field, const std::vector<T>& all) {
  std::set<std::string> ids;
  for (const T& each : all) {
    if (!ids.insert(each.id).second) fields.refuse(field + ": there are two '" + each.id + "'");
  }
}

}  // namespace

Procedure read_procedure(std::string_view json,
                         std::string_view file,
                         std::span<const NamedPredicate> predicates) {
  const nlohmann::json root = parse_json_text(json, file);
  JsonFields fields(root, std::string(file), "");
  Procedure procedure;
  procedure.id = fields.text("id");
  refuse_unless_snake_case(fields, procedure.id);
  if (const std::size_t slash = file.find('/');
      slash != std::string_view::npos && file.substr(0, slash) != procedure.id) {
    fields.refuse("id '" + procedure.id + "' must be the folder's name, '" +
                  std::string(file.substr(0, slash)) + "'");
  }
  procedure.title = fields.text("title");
  procedure.summary = fields.text("summary");
  procedure.target = read_bone(fields, "target", fields.text("target"));
  for (const std::string& name : fields.texts_or_none("allowed")) {
    procedure.allowed.push_back(read_bone(fields, "allowed", name));
  }
  for (const std::string& entry : fields.texts_or_none("tray")) {
    add_to_tray(fields, entry, procedure.tray);
  }
  if (procedure.tray.empty()) fields.refuse("tray is empty: there is nothing to operate with");
  for (JsonFields& entry : fields.objects("steps")) {
    procedure.steps.push_back(read_step(entry, predicates, procedure.tray));
  }
  if (procedure.steps.empty() || procedure.steps.size() > kMaxSteps) {
    fields.refuse("steps: there are " + std::to_string(procedure.steps.size()) + ", must be 1 to " +
                  std::to_string(kMaxSteps));
  }
  for (JsonFields& entry : fields.objects("views")) procedure.views.push_back(read_view(entry));
  procedure.rules = detail::read_score_rules(fields);
  procedure.decline = detail::read_decline_rules(fields);
  procedure.examines = fields.boolean_or("examines", false);
  procedure.controls_screw = fields.boolean_or("controls_screw", false);
  if (procedure.examines && procedure.controls_screw) {
    fields.refuse("controls_screw: an examination asks about other things");
  }
  if (fields.has("drill")) {
    JsonFields drill = fields.object("drill");
    procedure.drill = detail::read_scope_drill(drill);
  }
  if (fields.has("removal")) {
    JsonFields removal = fields.object("removal");
    procedure.removal = detail::read_loose_removal(removal);
  }
  if (fields.has("shaving")) {
    JsonFields shaving = fields.object("shaving");
    procedure.shaving = detail::read_shaving(shaving);
  }
  if (fields.has("portals")) {
    JsonFields portals = fields.object("portals");
    procedure.making = detail::read_portal_making(portals);
  }
  if (fields.has("fluid")) {
    JsonFields fluid = fields.object("fluid");
    procedure.fluid = detail::read_fluid_use(fluid);
  }
  procedure.judges_displacement = fields.boolean_or("judges_displacement", false);
  refuse_twins(fields, "steps", procedure.steps);
  refuse_twins(fields, "views", procedure.views);
  fields.refuse_unknown_fields();
  return procedure;
}

}  // namespace carpus::procedure
