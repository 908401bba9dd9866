// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/outline_message.hpp"

#include <cmath>

namespace carpus::view_trainer {

protocol::PictureOutline outline_message(const Polygon& polygon) {
  constexpr std::size_t kMost = 500;
  const std::size_t every = polygon.size() / kMost + 1;
  protocol::PictureOutline outline;
  for (std::size_t i = 0; i < polygon.size(); i += every) {
    outline.pixels.push_back(std::round(polygon[i].x * 10) / 10);
    outline.pixels.push_back(std::round(polygon[i].y * 10) / 10);
  }
  return outline;
}

std::vector<protocol::PictureOutline> outline_messages(const OutlineMap& shape) {
  constexpr std::size_t kMostOutlines = 4;
  std::vector<protocol::PictureOutline> messages;
  for (const Polygon& outline : shape.outlines()) {
    if (messages.size() < kMostOutlines) messages.push_back(outline_message(outline));
  }
  return messages;
}

}  // namespace carpus::view_trainer
