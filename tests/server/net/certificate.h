// A self-signed certificate of its own for each run, in files.
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace posed::net::test {

struct Certificate {
  explicit Certificate(const std::filesystem::path& folder)
      : certificate(folder / "certificate.pem"), key(folder / "key.pem") {
    EVP_PKEY* const pair = EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256");
    X509* const x509 = X509_new();
    ASN1_INTEGER_set(X509_get_serialNumber(x509), 1);
    X509_gmtime_adj(X509_getm_notBefore(x509), -3600);
    X509_gmtime_adj(X509_getm_notAfter(x509), 86'400);
    X509_set_pubkey(x509, pair);
    X509_NAME* const name = X509_get_subject_name(x509);
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("localhost"), -1, -1,
                               0);
    X509_set_issuer_name(x509, name);
    X509_sign(x509, pair, EVP_sha256());
    std::FILE* const certificate_file = std::fopen(certificate.c_str(), "w");
    PEM_write_X509(certificate_file, x509);
    std::fclose(certificate_file);
    std::FILE* const key_file = std::fopen(key.c_str(), "w");
    PEM_write_PrivateKey(key_file, pair, nullptr, nullptr, 0, nullptr, nullptr);
    std::fclose(key_file);
    X509_free(x509);
    EVP_PKEY_free(pair);
  }

  const std::filesystem::path certificate, key;
};

}  // namespace posed::net::test
