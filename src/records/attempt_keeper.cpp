// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/attempt_keeper.hpp"

#include <algorithm>
#include <exception>
#include <future>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "records/rescue_file.hpp"

namespace carpus::records {

namespace fs = std::filesystem;

AttemptKeeper::AttemptKeeper(const fs::path& file, Say say, KeeperPatience patience)
    : writing_(file, patience.busy),
      reading_(file, kReadPatience),
      say_(std::move(say)),
      patience_(patience) {
  thread_ = std::thread([this] { run(); });
}

AttemptKeeper::~AttemptKeeper() {
  (void)settle();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool AttemptKeeper::queue(Job job) {
  const std::lock_guard lock(mutex_);
  if (queue_.size() + waiting_ >= kMostWaiting) return false;
  queue_.push_back(std::move(job));
  changed_.notify_all();
  return true;
}

void AttemptKeeper::save(Attempt attempt, Done done) {
  if (queue([this, attempt = std::move(attempt), done]() mutable {
        done(keep(std::move(attempt)));
      })) {
    return;
  }
  done({0,
        "records " + file().string() + ": " + std::to_string(kMostWaiting) +
            " attempts wait to be stored, this one was not taken; free some space",
        false});
}

void AttemptKeeper::save(QuizAnswer answer, Done done) {
  if (queue(
          [this, answer = std::move(answer), done]() mutable { done(keep(std::move(answer))); })) {
    return;
  }
  done({0, "records " + file().string() + ": too much waits, the answer was not kept", false});
}

KeptAttempt AttemptKeeper::save(const Attempt& attempt) {
  auto kept = std::make_shared<std::promise<KeptAttempt>>();
  save(Attempt(attempt), [kept](const KeptAttempt& answer) { kept->set_value(answer); });
  return kept->get_future().get();
}

AssetSaving AttemptKeeper::save(const AssetForm& form, std::int64_t amended) {
  auto saved = std::make_shared<std::promise<AssetSaving>>();
  if (!queue([this, saved, form, amended] {
        try {
          saved->set_value(writing_.save(form, amended));
        } catch (const Error&) {
          saved->set_exception(std::current_exception());
        }
      })) {
    throw IoError("records " + file().string() + ": too much waits, the form was not stored");
  }
  return saved->get_future().get();
}

std::size_t AttemptKeeper::settle() {
  std::unique_lock lock(mutex_);
  const std::uint64_t mine = ++asked_to_settle_;
  changed_.notify_all();
  changed_.wait(lock, [&] { return settled_ >= mine; });
  return waiting_;
}

std::size_t AttemptKeeper::waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_;
}

void AttemptKeeper::run() {
  try_what_waits();
  std::unique_lock lock(mutex_);
  while (true) {
    const auto is_due = [this] {
      return stopping_ || !queue_.empty() || asked_to_settle_ > settled_;
    };
    const bool is_time = !changed_.wait_for(lock, patience_.retry, is_due);
    if (!queue_.empty()) {
      Job job = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      job();
      lock.lock();
      continue;
    }
    if (stopping_) return;
    if (is_time && waiting_ == 0) continue;
    const std::uint64_t asked = asked_to_settle_;
    lock.unlock();
    try_what_waits();
    lock.lock();
    settled_ = std::max(settled_, asked);
    changed_.notify_all();
  }
}

KeptAttempt AttemptKeeper::keep(Attempt attempt) {
  try {
    const std::int64_t id = writing_.save(attempt);
    if (waiting() > 0) try_what_waits();
    return {id, {}, true};
  } catch (const Error& error) {
    const fs::path rescued = rescue(writing_.file(), attempt);
    KeptAttempt kept{0, error.what(), !rescued.empty()};
    if (rescued.empty()) {
      in_memory_.push_back(std::move(attempt));
      kept.problem +=
          ". The attempt is kept in memory and stored when the records can be written again; do "
          "not stop the program before";
    } else {
      kept.problem += ". The attempt was saved to " + rescued.string() +
                      " instead, and is taken from there when the records can be written again";
    }
    const std::lock_guard lock(mutex_);
    ++waiting_;
    return kept;
  }
}

KeptAttempt AttemptKeeper::keep(QuizAnswer answer) {
  try {
    return {writing_.save(answer), {}, true};
  } catch (const Error& error) {
    answers_in_memory_.push_back(std::move(answer));
    const std::lock_guard lock(mutex_);
    ++waiting_;
    return {0,
            std::string(error.what()) +
                ". The answer is kept in memory and stored when the records can be written again",
            false};
  }
}

void AttemptKeeper::try_what_waits() {
  while (!in_memory_.empty()) {
    try {
      const std::int64_t id = writing_.save(in_memory_.front());
      say("an attempt that waited in memory is stored as attempt " + std::to_string(id));
    } catch (const Error&) {
      break;
    }
    in_memory_.erase(in_memory_.begin());
  }
  while (!answers_in_memory_.empty()) {
    try {
      (void)writing_.save(answers_in_memory_.front());
    } catch (const Error&) {
      break;
    }
    answers_in_memory_.erase(answers_in_memory_.begin());
  }
  take_back_rescued();
}

void AttemptKeeper::take_back_rescued() {
  std::size_t left = 0;
  for (const fs::path& file : rescue_files(writing_.file())) {
    try {
      for (const std::int64_t id : take_back(writing_, file)) {
        say(file.string() + ": the attempt that was rescued here is stored as attempt " +
            std::to_string(id));
      }
    } catch (const Error& error) {
      ++left;
      if (waiting() == 0) say(file.string() + ": a rescued attempt waits: " + error.what());
    }
  }
  const std::lock_guard lock(mutex_);
  waiting_ = in_memory_.size() + answers_in_memory_.size() + left;
}

void AttemptKeeper::say(const std::string& line) const {
  if (say_) say_(line);
}

std::vector<AttemptSummary> AttemptKeeper::list() const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.list();
}

AttemptPage AttemptKeeper::page(std::int64_t before,
                                std::size_t most,
                                const AttemptFilter& seen) const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.page(before, most, seen);
}

std::optional<Attempt> AttemptKeeper::find(std::int64_t id) const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.find(id);
}

QuizAnswerPage AttemptKeeper::quiz_page(std::int64_t before,
                                        std::size_t most,
                                        const AttemptFilter& seen) const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.quiz_page(before, most, seen);
}

std::vector<AssetForm> AttemptKeeper::asset_forms(std::int64_t attempt) const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.asset_forms(attempt);
}

bool AttemptKeeper::holds(const std::string& origin) const {
  const std::lock_guard lock(reading_mutex_);
  return reading_.holds(origin);
}

}  // namespace carpus::records
