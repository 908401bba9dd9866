// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the station speaks TLS. Private to the network server.
#pragma once

#include <utility>  // before asio: its 1.74 needs std::exchange and does not include it
//
#include <boost/asio/ssl/context.hpp>
#include <filesystem>
#include <optional>

namespace carpus::server::detail {

/// Nothing where no file is given.
/// @param certificate  PEM, with those that vouch for it behind it
/// @param key  PEM, without a pass phrase
/// @throws InvalidInput  only one is given; IoError  naming the file and what is wrong with it.
[[nodiscard]] std::optional<boost::asio::ssl::context> make_tls_context(
    const std::filesystem::path& certificate,
    const std::filesystem::path& key);

}  // namespace carpus::server::detail
