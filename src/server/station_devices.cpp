// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page does with the station's devices, and what it is told of them. One that fails stops
// time: nothing is lost, and nobody drills on with a hand that is not there.
#include <variant>

#include "server/station.hpp"

namespace carpus::server {

bool Station::is_of_devices(const protocol::PageMessage& message) {
  return std::holds_alternative<protocol::FindDevices>(message) ||
         std::holds_alternative<protocol::UseDevice>(message) ||
         std::holds_alternative<protocol::TestWall>(message) ||
         std::holds_alternative<protocol::Calibrate>(message);
}

bool Station::time_passes() const {
  return exercise_ && !paused_by_page_ && !paused_by_silence_ && !paused_by_disk_ &&
         !paused_by_device_;
}

void Station::on_message(const protocol::FindDevices&) {
  devices_->find();
  send(devices_->message());
}

void Station::on_message(const protocol::UseDevice& wish) { devices_->use(wish); }

void Station::on_message(const protocol::TestWall& wish) {
  devices_->test_wall(wish, time_passes());
}

void Station::on_message(const protocol::Calibrate& wish) {
  devices_->calibrate(wish, time_passes());
}

void Station::watch_devices() {
  if (const auto lost = devices_->look()) {
    log_(*lost);
    if (time_passes()) {
      paused_by_device_ = true;
      apply_pause();
      refuse(*lost + ": the operation is paused, and nothing of it is lost.",
             "Plug it in again, then resume; or give this hand to mouse and keys (Devices).");
    } else {
      refuse(*lost + ".", "Plug it in again; it goes on by itself.");
    }
  }
  if (operator_ && devices_->is_due()) send(devices_->message());
}

}  // namespace carpus::server
