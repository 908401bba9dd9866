// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Attempts of the records as messages of the protocol.
#pragma once

#include <string>
#include <vector>

#include "protocol/bodies.hpp"
#include "records/attempt.hpp"
#include "records/attempt_store.hpp"
#include "server/case_shelf.hpp"

namespace carpus::server {

[[nodiscard]] protocol::AttemptList attempt_list(const records::AttemptPage& page);

/// Without those that name a place that this program does not know: a newer one wrote them.
[[nodiscard]] protocol::QuizAnswerList quiz_answer_list(const records::QuizAnswerPage& page);

/// Whether the truth of an attempt may be told: it was practice, or an assessed one that ended with
/// something to assess.
[[nodiscard]] bool is_truth_open(const records::Attempt& attempt);

/// Score and log are absent where what is stored of them cannot be read; of an attempt whose truth
/// stays locked the log holds what was told while it ran.
/// @param open_case_fingerprint  of the case that is served: places of an attempt mean nothing in
/// another patient's bones.
/// @param cases  among which its own may be
[[nodiscard]] protocol::Attempt attempt_message(const records::Attempt& attempt,
                                                const std::string& open_case_fingerprint,
                                                const CaseShelf& cases);

}  // namespace carpus::server
