// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/types.hpp"
#include "view_trainer/outline_map.hpp"

namespace carpus::view_trainer {

/// At most as many corners as a message takes, to a tenth of a pixel.
[[nodiscard]] protocol::PictureOutline outline_message(const Polygon& polygon);

/// A shape's outer outlines, as many as a message takes, longest first.
[[nodiscard]] std::vector<protocol::PictureOutline> outline_messages(const OutlineMap& shape);

}  // namespace carpus::view_trainer
