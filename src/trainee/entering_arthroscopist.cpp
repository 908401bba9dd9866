// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/entering_arthroscopist.hpp"

#include <algorithm>
#include <array>

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kWorks = 1;
constexpr Tick kDrawTicks = 1500;
constexpr double kDrawnMm = 0.03;                // a tick, out of the portal that was made
constexpr std::array kNeedleBeyondMm{2.0, 4.0};  // of the capsule

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

/// Where the second portal comes in, from a little beyond the capsule on: there its needle shows.
std::vector<cases::TourPoint> EnteringArthroscopist::where_needle_comes_in(
    const simulation::Snapshot& now) const {
  const cases::Portal& portal = data_.arthroscopy->portals[now.skin.facts.asked[1]];
  std::vector<cases::TourPoint> places;
  for (const double beyond_mm : kNeedleBeyondMm) {
    cases::TourPoint place;
    place.at = portal.skin + portal.inwards * (portal.capsule_mm + beyond_mm);
    place.body = portal.body;
    place.joint = portal.joint;
    places.push_back(place);
  }
  return places;
}

simulation::Input EnteringArthroscopist::make(const simulation::Snapshot& now) {
  simulation::Input input = maker_.next(now);
  if (looker_ != nullptr) {
    input.hands[kScope] = looker_->next(now).hands[kScope];
  } else if (maker_.works_under_vision()) {
    drawn_ = 0;
    stage_ = Stage::DrawOut;
  }
  if (maker_.is_done() && now.skin.facts.made == procedure::kPortalsMade) {
    input.command = {};  // it would have finished
    drawn_ = 0;
    stage_ = Stage::DrawOut;
  }
  return input;
}

/// The sheath, whichever hand holds it.
simulation::Input EnteringArthroscopist::draw_out(const simulation::Snapshot& now) {
  simulation::Input input = last_;
  input.command = {};
  const std::uint8_t hand = looker_ != nullptr ? kWorks : kScope;
  input.hands[hand].driver = simulation::Driver::Off;
  if (++drawn_ < kDrawTicks) {
    input.hands[hand].tip_in_patient += input.hands[hand].shaft_in_patient * kDrawnMm;
    return input;
  }
  map_ = as_made(*data_.arthroscopy, now.skin);
  if (looker_ != nullptr) {
    looker_->goes_on();
    stage_ = Stage::Look;
    return input;
  }
  input.command.kind = simulation::CommandKind::Take;
  input.command.index = look_.tray.front();
  stage_ = maker_.is_done() ? Stage::Look : Stage::Watch;
  return input;
}

simulation::Input EnteringArthroscopist::look(const simulation::Snapshot& now) {
  if (looker_ == nullptr) {
    looker_ = std::make_unique<ScriptedArthroscopist>(data_, look_, skill_, seed_, &map_);
    if (stage_ == Stage::Watch) {
      looker_->watches_first(now.skin.ways[0].portal, where_needle_comes_in(now));
    }
  }
  simulation::Input input = looker_->next(now);
  if (stage_ == Stage::Watch && looker_->holds_still()) {
    maker_.works_with(kWorks);
    stage_ = Stage::Make;
  }
  return input;
}

simulation::Input EnteringArthroscopist::next(const simulation::Snapshot& now) {
  switch (stage_) {
    case Stage::Make:
      last_ = make(now);
      break;
    case Stage::DrawOut:
      last_ = draw_out(now);
      break;
    case Stage::Watch:
    case Stage::Look:
      last_ = look(now);
      break;
  }
  return last_;
}

}  // namespace carpus::trainee
