// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Portals again, 3-4 and one of the less usual ones, which lie beside a nerve or an artery
// [clinical: B7]: procedure.json says what of arthroscopic_portal_making is otherwise here, as a
// merge patch [RFC 7396].
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_portal_making_harder {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when what the merge gives is wrong.
[[nodiscard]] const procedure::Procedure& declared();

}  // namespace carpus::procedures::arthroscopic_portal_making_harder
