#include "rpc/credentials.h"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <string>
#include <system_error>

#include "base/error.h"
#include "files/file.h"

namespace scene_analyzer::rpc {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestFile = 1 << 20;

std::string read_pem(const char* option, const fs::path& path) {
  try {
    files::File file = files::File::open_regular(path);
    if (file.size() > kLargestFile)
      throw UsageError(fmt::format("--{}: '{}' is too large", option, path.string()));
    std::string text(static_cast<std::size_t>(file.size()), '\0');
    text.resize(file.read(text));
    return text;
  } catch (const std::system_error& error) {
    throw UsageError(
        fmt::format("--{}: '{}' cannot be read: {}", option, path.string(), files::describe(error.code())));
  }
}

using Bio = std::unique_ptr<BIO, decltype(&BIO_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;

Bio reader_of(const std::string& text) {
  return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free};
}

Certificate first_certificate(const char* option, const fs::path& path, const std::string& text) {
  const Bio reader = reader_of(text);
  Certificate certificate(PEM_read_bio_X509(reader.get(), nullptr, nullptr, nullptr), X509_free);
  ERR_clear_error();
  if (!certificate)
    throw UsageError(fmt::format("--{}: '{}' holds no certificate in PEM", option, path.string()));
  return certificate;
}

void check_belong_together(const Tls& tls, const std::string& chain, const std::string& key_text) {
  const Certificate certificate = first_certificate("tls-cert", tls.certificate, chain);
  const Bio reader = reader_of(key_text);
  // A key behind a passphrase would ask at the terminal.
  const auto no_passphrase = [](char*, int, int, void*) { return 0; };
  const Key key(PEM_read_bio_PrivateKey(reader.get(), nullptr, no_passphrase, nullptr), EVP_PKEY_free);
  const bool match = key && X509_check_private_key(certificate.get(), key.get()) == 1;
  ERR_clear_error();
  if (!key)
    throw UsageError(
        fmt::format("--tls-key: '{}' holds no private key in PEM without a passphrase", tls.key.string()));
  if (!match)
    throw UsageError(fmt::format("--tls-key: '{}' is not the key of the certificate '{}'", tls.key.string(),
                                 tls.certificate.string()));
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> make_credentials(const std::optional<Tls>& tls) {
  if (!tls) return grpc::InsecureServerCredentials();
  const std::string chain = read_pem("tls-cert", tls->certificate), key = read_pem("tls-key", tls->key);
  check_belong_together(*tls, chain, key);
  grpc::SslServerCredentialsOptions options(tls->client_ca
                                                ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                                                : GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  options.pem_key_cert_pairs.push_back({key, chain});
  if (tls->client_ca) {
    options.pem_root_certs = read_pem("client-ca", *tls->client_ca);
    first_certificate("client-ca", *tls->client_ca, options.pem_root_certs);
  }
  return grpc::SslServerCredentials(options);
}

}  // namespace scene_analyzer::rpc
