// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/detail/tls_context.hpp"

#include <openssl/ssl.h>

#include <string>

#include "core/error.hpp"

namespace carpus::server::detail {

namespace {

using boost::asio::ssl::context;
using boost::system::error_code;

[[noreturn]] void fail(const std::filesystem::path& file,
                       const std::string& what,
                       const error_code& error) {
  throw IoError(file.string() + ": " + what + ": " + error.message());
}

}  // namespace

std::optional<context> make_tls_context(const std::filesystem::path& certificate,
                                        const std::filesystem::path& key) {
  if (certificate.empty() && key.empty()) return std::nullopt;
  if (certificate.empty() || key.empty()) {
    throw InvalidInput("TLS needs both files: give --certificate and --key");
  }
  std::optional<context> tls(std::in_place, context::tls_server);
  ::SSL_CTX_set_min_proto_version(tls->native_handle(), TLS1_2_VERSION);
  ::SSL_CTX_set_options(tls->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  // Sessions that are taken up again would be kept for every address that ever came.
  ::SSL_CTX_set_session_cache_mode(tls->native_handle(), SSL_SESS_CACHE_OFF);
  // A terminal that waits for a pass phrase would be a station that does not start.
  tls->set_password_callback([](std::size_t, context::password_purpose) { return std::string(); });
  error_code error;
  tls->use_certificate_chain_file(certificate.string(), error);
  if (error) fail(certificate, "is no certificate in PEM that can be read (--certificate)", error);
  tls->use_private_key_file(key.string(), context::pem, error);
  if (error) {
    fail(key, "is no key in PEM, without pass phrase, that fits the certificate (--key)", error);
  }
  return tls;
}

}  // namespace carpus::server::detail
