// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/entering_arthroscopist.hpp"

#include <algorithm>

namespace carpus::trainee {
namespace {

constexpr Tick kDrawTicks = 1500;
constexpr double kDrawnMm = 0.03;  // a tick, out of the second portal

/// The case's map with the portals that were made in place of its own, and of its points those that
/// they lead to.
cases::ArthroscopicMap as_made(const cases::ArthroscopicMap& map,
                               const simulation::SkinView& skin) {
  cases::ArthroscopicMap own = map;
  for (cases::Portal& portal : own.portals) portal.is_usual = false;
  for (std::size_t i = 0; i < skin.way_count; ++i) {
    const simulation::OwnWayView& way = skin.ways[i];
    cases::Portal& portal = own.portals[way.portal];
    portal.is_usual = true;
    portal.joint = way.joint;
    portal.skin = way.skin;
    portal.inwards = way.inwards;
    portal.capsule_mm = way.capsule_mm;
  }
  for (cases::TourPoint& point : own.points) {
    point.by.clear();
    for (std::size_t i = 0; i < skin.way_count; ++i) {
      const simulation::OwnWayView& way = skin.ways[i];
      if (way.joint == point.joint) point.by.push_back(way.portal);
    }
  }
  return own;
}

}  // namespace

bool EnteringArthroscopist::knows(const procedure::Procedure& procedure) {
  return procedure.making &&
         std::any_of(procedure.tray.begin(), procedure.tray.end(), [](const auto index) {
           return instruments::catalogue()[index].optic.has_value();
         });
}

EnteringArthroscopist::EnteringArthroscopist(const cases::CaseData& data,
                                             const procedure::Procedure& procedure,
                                             Skill skill,
                                             std::uint64_t seed)
    : data_(data),
      look_(procedure),
      skill_(skill),
      seed_(seed),
      maker_(data, procedure, skill, seed) {
  std::erase_if(look_.tray,
                [](const auto index) { return !instruments::catalogue()[index].enters_joints; });
}

void EnteringArthroscopist::begin_to_look(const simulation::Snapshot& now) {
  map_ = as_made(*data_.arthroscopy, now.skin);
  looker_ = std::make_unique<ScriptedArthroscopist>(data_, look_, skill_, seed_, &map_);
}

simulation::Input EnteringArthroscopist::next(const simulation::Snapshot& now) {
  if (looker_ != nullptr) return looker_->next(now);
  if (!maker_.is_done()) {
    last_ = maker_.next(now);
    const bool goes_on = maker_.is_done() && now.skin.facts.made == procedure::kPortalsMade;
    if (goes_on) last_.command = {};  // it would have finished
    return last_;
  }
  last_.command = {};
  last_.hands[0].driver = simulation::Driver::Off;
  if (++drawn_ < kDrawTicks) {
    last_.hands[0].tip_in_patient += last_.hands[0].shaft_in_patient * kDrawnMm;
    return last_;
  }
  if (drawn_ == kDrawTicks) {
    last_.command.kind = simulation::CommandKind::Take;
    last_.command.index = look_.tray.front();
    return last_;
  }
  begin_to_look(now);
  return looker_->next(now);
}

}  // namespace carpus::trainee
