#include "airsim360/base/signature.h"

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr size_t kKeyBytes = 32, kSignatureBytes = 64;

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Context = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Key ReadKey(std::string_view pem) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), BIO_free);
  // No password is asked for: an encrypted key is none.
  const auto no_password = [](char*, int, int, void*) { return 0; };
  Key key(bio ? PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, nullptr) : nullptr, EVP_PKEY_free);
  if (!key || EVP_PKEY_id(key.get()) != EVP_PKEY_ED25519)
    throw InputError("is no private key of Ed25519: make one with 'openssl genpkey -algorithm ed25519 -out key.pem'");
  return key;
}

const unsigned char* Unsigned(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

std::string Hex(const unsigned char* bytes, size_t count) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

std::optional<std::vector<unsigned char>> BytesOfHex(std::string_view hex, size_t count) {
  if (hex.size() != 2 * count) return std::nullopt;
  std::vector<unsigned char> bytes(count);
  for (size_t i = 0; i < hex.size(); ++i) {
    const char c = hex[i];
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    if (digit < 0) return std::nullopt;
    bytes[i / 2] = static_cast<unsigned char>(bytes[i / 2] << 4 | digit);
  }
  return bytes;
}

}  // namespace

std::string PublicKeyOf(std::string_view pem) {
  const Key key = ReadKey(pem);
  std::array<unsigned char, kKeyBytes> bytes{};
  size_t size = bytes.size();
  if (EVP_PKEY_get_raw_public_key(key.get(), bytes.data(), &size) != 1) throw RuntimeError("the public key cannot be had");
  return Hex(bytes.data(), size);
}

std::string SignText(std::string_view pem, std::string_view text) {
  const Key key = ReadKey(pem);
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::array<unsigned char, kSignatureBytes> bytes{};
  size_t size = bytes.size();
  if (EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) != 1 ||
      EVP_DigestSign(context.get(), bytes.data(), &size, Unsigned(text), text.size()) != 1)
    throw RuntimeError("signing failed");
  return Hex(bytes.data(), size);
}

bool IsSignedBy(std::string_view public_key, std::string_view text, std::string_view signature) {
  const auto raw = BytesOfHex(public_key, kKeyBytes), signed_bytes = BytesOfHex(signature, kSignatureBytes);
  if (!raw || !signed_bytes) return false;
  const Key key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, raw->data(), raw->size()), EVP_PKEY_free);
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  return key && EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
         EVP_DigestVerify(context.get(), signed_bytes->data(), signed_bytes->size(), Unsigned(text), text.size()) == 1;
}

}  // namespace airsim360
