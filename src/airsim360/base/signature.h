// Signatures that anybody can check: Ed25519 (RFC 8032), by OpenSSL's libcrypto.
#pragma once

#include <string>
#include <string_view>

namespace airsim360 {

/// `key`: PEM of a private key, as `openssl genpkey -algorithm ed25519` writes it. InputError if it is none.
std::string PublicKeyOf(std::string_view key);                      ///< 64 hexadecimal digits
std::string SignText(std::string_view key, std::string_view text);  ///< 128 hexadecimal digits
/// Whether `signature` was made of `text` with the private key that belongs to `public_key`; both as above. False for what is none.
bool IsSignedBy(std::string_view public_key, std::string_view text, std::string_view signature);

}  // namespace airsim360
