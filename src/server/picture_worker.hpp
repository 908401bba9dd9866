// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluoroscopy pictures, rendered in a thread of their own so that neither the hand nor the network
// waits for them.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cases/case_data.hpp"
#include "server/exercise.hpp"
#include "session/exercise_pictures.hpp"

namespace carpus::server {

/// The binary frame of protocol/README.md.
[[nodiscard]] std::string encode_picture(const TakenShot& shot, const fluoroscopy::Image& image);

class PictureWorker {
 public:
  /// Called in the worker's thread; the frame is empty when the picture could not be made.
  using Deliver = std::function<void(const TakenShot& shot, std::string frame)>;

  PictureWorker(const cases::CaseData& data, Deliver deliver);
  ~PictureWorker();
  PictureWorker(const PictureWorker&) = delete;
  PictureWorker& operator=(const PictureWorker&) = delete;

  /// Shots are made in turn, before live pictures; of those only the newest is.
  void request(const TakenShot& shot);
  /// Forgets what was asked for and not yet begun.
  void clear();

 private:
  void run();
  [[nodiscard]] std::string frame_of(const TakenShot& shot);
  [[nodiscard]] TakenShot next_in_turn();

  session::ExercisePictures pictures_;
  Deliver deliver_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<TakenShot> queue_;
  std::optional<TakenShot> live_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace carpus::server
