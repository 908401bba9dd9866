// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/picture_worker.hpp"

#include <bit>
#include <utility>

#include "procedure/shots.hpp"
#include "simulation/c_arm_angles.hpp"

namespace carpus::server {

namespace {

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFFU);
}

void append(std::string& bytes, double value) {
  append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
}

}  // namespace

std::string encode_picture(const TakenShot& shot, const fluoroscopy::Image& image) {
  const bool is_single = shot.kind == PictureKind::Shot || shot.kind == PictureKind::Quiz;
  std::string bytes = "CARM";
  append(bytes, 3, 4);
  append(bytes, static_cast<std::uint32_t>(shot.kind), 4);
  append(bytes, shot.number, 4);
  append(bytes, static_cast<std::uint32_t>(image.width), 2);
  append(bytes, static_cast<std::uint32_t>(image.height), 2);
  append(bytes, image.pixel_mm);
  append(bytes,
         simulation::held_rotation_deg(shot.rotation_deg, shot.snapshot.wrist.pronation_rad));
  append(bytes, shot.tilt_deg);
  append(bytes, procedure::dose_cgy_cm2(std::uint64_t{is_single ? procedure::kPulsesPerShot : 1U} *
                                        procedure::dose_units(shot.snapshot.tube)));
  append(bytes, static_cast<double>(procedure::kTubeKv[procedure::voltage_of(shot.snapshot.tube)]));
  bytes.append(image.grey.begin(), image.grey.end());
  return bytes;
}

PictureWorker::PictureWorker(const cases::CaseData& data, Deliver deliver)
    : pictures_(data), deliver_(std::move(deliver)) {
  thread_ = std::thread([this] { run(); });
}

PictureWorker::~PictureWorker() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void PictureWorker::request(const TakenShot& shot) {
  {
    const std::lock_guard lock(mutex_);
    if (shot.kind == PictureKind::Live) {
      live_ = shot;
    } else {
      if (shot.kind == PictureKind::Held) live_.reset();  // it is newer
      queue_.push_back(shot);
    }
  }
  wake_.notify_one();
}

void PictureWorker::clear() {
  const std::lock_guard lock(mutex_);
  queue_.clear();
  live_.reset();
}

TakenShot PictureWorker::next_in_turn() {
  TakenShot shot;
  if (!queue_.empty()) {
    shot = queue_.front();
    queue_.pop_front();
  } else {
    shot = *live_;
    live_.reset();
  }
  return shot;
}

std::string PictureWorker::frame_of(const TakenShot& shot) {
  const session::PictureView view{shot.target, shot.rotation_deg, shot.tilt_deg};
  try {
    switch (shot.kind) {
      case PictureKind::Live:
        return encode_picture(shot, pictures_.take_live(view, shot.snapshot));
      case PictureKind::Held:
        return encode_picture(shot, pictures_.take_held(view, shot.snapshot));
      case PictureKind::Shot:
        return encode_picture(shot, pictures_.take(view, shot.snapshot));
      case PictureKind::Quiz:
        break;  // the quiz makes its own
    }
    return {};
  } catch (const std::exception&) {
    return {};
  }
}

void PictureWorker::run() {
  while (true) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return stopping_ || !queue_.empty() || live_; });
    if (stopping_) return;
    const TakenShot shot = next_in_turn();
    lock.unlock();
    deliver_(shot, frame_of(shot));
  }
}

}  // namespace carpus::server
