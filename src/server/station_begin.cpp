// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How an exercise begins: it is set up in another thread, since nobody else should wait for that.
#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/person_name.hpp"
#include "server/station.hpp"
#include "simulation/lesions_of.hpp"

namespace carpus::server {

using std::chrono::steady_clock;

std::uint64_t Station::number_of_now() {
  using std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<milliseconds>(now).count());
}

void Station::on_message(const protocol::Start& start) {
  const procedure::Procedure* procedure = procedures_.find(start.procedure);
  if (procedure == nullptr) {
    return refuse("There is no procedure '" + start.procedure + "'",
                  "Choose one of those that the station offers.");
  }
  if (const auto problem = problem_of_name(start.trainee)) {
    return refuse(*problem, "Type the name anew, then start.");
  }
  store_running();
  own_what_begins();
  exercise_number_ = std::max(exercise_number_ + 1, number_of_now());
  ExerciseSetup setup;
  setup.trainee = start.trainee;
  setup.input_device = name_of(start.input_device);
  setup.procedure = procedure;
  setup.mode = static_cast<procedure::Mode>(start.mode.value_or(protocol::Mode::Practice));
  setup.seed = static_cast<std::uint64_t>(start.seed);
  setup.number = exercise_number_;
  setup.guest = &devices_->guest();
  is_beginning_ = true;
  over_cases_.truth->close(setup.mode == procedure::Mode::Assessed);
  do_aside([this, setup = std::move(setup), owner = owner_word_, network = network_]() mutable {
    BegunExercise begun;
    try {
      if (setup.procedure->examines) {
        setup.prepared = simulation::pathology_to_begin_with(
            *setup.procedure, setup.seed,
            over_cases_.prepared ? over_cases_.prepared() : data_.pathology);
      }
      ExerciseStart beginning = begin_anew(data_, case_fingerprint_, setup, records_.file());
      begun.exercise = std::make_unique<Exercise>(data_, setup, std::move(beginning));
      begun.exercise->loop().pause(true);
      begun.exercise->note_owner(owner);
    } catch (const std::exception& error) {
      begun.problem = error.what();
    }
    {
      const std::lock_guard lock(begun_mutex_);
      begun_ = std::move(begun);
    }
    if (network != nullptr) network->post([this] { take_begun(); });
  });
}

void Station::do_aside(WorkThread::Work work) {
  // More than it takes can only wait where somebody starts again and again: they wait themselves.
  if (!aside_ || !aside_->post(work)) work();
}

void Station::take_begun() {
  BegunExercise begun;
  {
    const std::lock_guard lock(begun_mutex_);
    begun = std::exchange(begun_, {});
  }
  if (!begun.exercise && begun.problem.empty()) return;
  is_beginning_ = false;
  std::vector<protocol::PageMessage> asked = std::exchange(asked_meanwhile_, {});
  if (!begun.exercise) {
    log_(begun.problem);
    operator_owns_ = false;
    over_cases_.truth->close(false);
    return refuse(begun.problem, "Change what the message says and try again.");
  }
  exercise_ = std::move(begun.exercise);
  // Its page may have gone meanwhile, or come again, or another may have come.
  const bool went_on = operator_ && operator_owns_;
  operator_owns_ = operator_ && (went_on || owns(operator_word_));
  paused_by_page_ = !went_on;
  paused_by_silence_ = false;
  paused_by_disk_ = false;
  paused_by_device_ = false;
  journal_watch_ = {};
  left_at_ = last_heard_ = steady_clock::now();
  pictures_->clear();
  shown_.clear();
  apply_pause();
  welcome();
  if (may_watch()) send(exercise_->session().exercise());
  for (const protocol::PageMessage& message : asked) {
    // The first of them may begin yet another.
    if (is_beginning_) {
      asked_meanwhile_.push_back(message);
    } else {
      obey(message);
    }
  }
}

}  // namespace carpus::server
