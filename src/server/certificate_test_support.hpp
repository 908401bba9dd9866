// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A certificate for 127.0.0.1 that vouches for itself, for tests alone.
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace carpus::server::testing {

/// Writes `certificate` and `key` as PEM.
inline void write_certificate(const std::filesystem::path& certificate,
                              const std::filesystem::path& key) {
  const std::unique_ptr<EVP_PKEY, decltype(&::EVP_PKEY_free)> pair(EVP_EC_gen("P-256"),
                                                                   &::EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&::X509_free)> x509(::X509_new(), &::X509_free);
  ::X509_set_version(x509.get(), 2);
  ::ASN1_INTEGER_set(::X509_get_serialNumber(x509.get()), 1);
  ::X509_gmtime_adj(::X509_getm_notBefore(x509.get()), 0);
  ::X509_gmtime_adj(::X509_getm_notAfter(x509.get()), 3600);
  ::X509_set_pubkey(x509.get(), pair.get());
  X509_NAME* const name = ::X509_get_subject_name(x509.get());
  ::X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>("127.0.0.1"), -1, -1, 0);
  ::X509_set_issuer_name(x509.get(), name);
  ::X509_sign(x509.get(), pair.get(), ::EVP_sha256());
  FILE* file = std::fopen(certificate.c_str(), "w");
  ::PEM_write_X509(file, x509.get());
  std::fclose(file);
  file = std::fopen(key.c_str(), "w");
  ::PEM_write_PrivateKey(file, pair.get(), nullptr, nullptr, 0, nullptr, nullptr);
  std::fclose(file);
}

}  // namespace carpus::server::testing
