// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/journal_writer.hpp"

#include <sys/file.h>
#include <sys/stat.h>

#include <cstring>
#include <utility>

#include "records/detail/file_advice.hpp"
#include "records/journal_block.hpp"

namespace carpus::records {

JournalWriter::JournalWriter(JournalPlace place)
    : place_(std::move(place)), next_place_(place_.sound_size) {
  if (next_place_ == 0) {
    const auto magic = std::as_bytes(std::span(kJournalMagic.data(), kJournalMagic.size()));
    waiting_.assign(magic.begin(), magic.end());
    next_place_ = magic.size();
  }
  thread_ = std::thread([this] { run(); });
}

JournalWriter::~JournalWriter() { end_thread(); }

void JournalWriter::end_thread() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void JournalWriter::append(std::uint8_t kind,
                           std::span<const std::byte> content,
                           std::uint64_t mark) {
  {
    const std::lock_guard lock(mutex_);
    if (given_up_) return;
    if (waiting_.size() + content.size() > kMostWaiting) {
      given_up_ = true;
      progress_.problem += "; what is done from now on is in memory only";
      return;
    }
    const std::vector<std::byte> block = encode_journal_block(next_place_, kind, content);
    waiting_.insert(waiting_.end(), block.begin(), block.end());
    next_place_ += block.size();
    progress_.appended = mark;
  }
  changed_.notify_all();
}

JournalProgress JournalWriter::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool JournalWriter::wait_until_safe(std::chrono::milliseconds time) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [this] {
    return !given_up_ && progress_.written_bytes == next_place_ && progress_.problem.empty();
  });
}

void JournalWriter::remove() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    given_up_ = true;
  }
  end_thread();
  ::unlink(place_.file.c_str());
  (void)detail::flush_folder_of(place_.file);
}

void JournalWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    const bool is_last = stopping_;
    write_what_waits(lock);
    if (is_last) return;
    if (!progress_.problem.empty()) changed_.wait_for(lock, kRetry, [this] { return stopping_; });
  }
}

void JournalWriter::write_what_waits(std::unique_lock<std::mutex>& lock) {
  if (waiting_.empty()) return;
  const std::vector<std::byte> bytes = waiting_;
  const std::uint64_t mark = progress_.appended;
  lock.unlock();
  const bool is_written = write(bytes);
  const int error = errno;
  lock.lock();
  if (is_written) {
    place_.sound_size += bytes.size();
    // Unless it was removed meanwhile.
    if (!waiting_.empty()) {
      waiting_.erase(waiting_.begin(),
                     waiting_.begin() + static_cast<std::ptrdiff_t>(bytes.size()));
    }
    progress_.written_bytes = place_.sound_size;
    progress_.safe = mark;
    if (!given_up_) progress_.problem.clear();
  } else if (!given_up_) {
    progress_.problem = place_.file.string() +
                        ": what is being done cannot be kept on disk: " + std::strerror(error) +
                        "; " + detail::advice(error);
  }
  changed_.notify_all();
}

bool JournalWriter::write(std::span<const std::byte> bytes) {
  // After a refusal all of it goes to the same place again: after a failed flush nobody knows what
  // the disk has.
  if (!prepare() || !detail::write_at(place_.descriptor.number(), place_.sound_size, bytes) ||
      ::fdatasync(place_.descriptor.number()) != 0) {
    return false;
  }
  is_named_ = is_named_ || detail::flush_folder_of(place_.file);
  return is_named_;
}

bool JournalWriter::prepare() {
  if (is_ready_) return true;
  if (!place_.descriptor.is_open()) {
    constexpr int kNew = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    constexpr mode_t kOwnersOnly = 0600;  // it names a trainee
    place_.descriptor = detail::FileDescriptor(::open(place_.file.c_str(), kNew, kOwnersOnly));
    // Who looks for journals that were left behind leaves alone what is locked.
    if (!place_.descriptor.is_open() || ::flock(place_.descriptor.number(), LOCK_EX | LOCK_NB) != 0)
      return false;
  }
  is_ready_ = ::ftruncate(place_.descriptor.number(), static_cast<off_t>(place_.sound_size)) == 0;
  return is_ready_;
}

}  // namespace carpus::records
