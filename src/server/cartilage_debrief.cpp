// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/cartilage_debrief.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "arthroscopy/seen_share.hpp"
#include "session/body_names.hpp"

namespace carpus::server {
namespace {

constexpr std::size_t kMostFacets = 8000;  // as protocol.json has it

}  // namespace

protocol::SeenCartilage seen_cartilage(const cases::CaseData& data,
                                       const procedure::ScopeRecord& scope) {
  const cases::ArthroscopicMap& map = *data.arthroscopy;
  const arthroscopy::SeenCartilage seen =
      arthroscopy::seen_by(data, map, scope.looks, scope.least_cosine);
  const session::BodyNames names(data);
  std::vector<protocol::CartilageOfBone> bones(data.bones.size());
  for (std::size_t i = 0; i < map.cartilage.size(); ++i) {
    protocol::CartilageOfBone& bone = bones[map.cartilage[i].body];
    if (bone.at_mm.size() >= kMostFacets) continue;
    bone.at_mm.push_back(map.cartilage[i].at);
    bone.seen.push_back(seen.seen()[i] ? 1 : 0);
  }
  protocol::SeenCartilage message;
  message.share = seen.share() * 100;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    if (bones[b].at_mm.empty()) continue;
    bones[b].bone = names.name(b);
    bones[b].seen_share = seen.share_of(static_cast<std::uint8_t>(b)) * 100;
    message.bones.push_back(std::move(bones[b]));
  }
  return message;
}

}  // namespace carpus::server
