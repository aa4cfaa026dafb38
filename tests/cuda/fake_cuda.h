// What tests ask of the stand-in for NVIDIA's driver (fake_cuda.cc).
#pragma once

extern "C" {
/// The calls so far, one a line: name, then what it was given. "error: …" where it was misused.
const char* fake_cuda_calls();
void fake_cuda_forget();
/// UUID of device 0 or 1, 16 bytes.
void fake_cuda_set_uuid(int device, const unsigned char* uuid);
/// The next such call gives that error.
void fake_cuda_fail(const char* call, int error);
/// Bytes that stand before the memory in the files of Vulkan's driver (Mesa's lavapipe has some).
void fake_cuda_set_header(unsigned long long bytes);
/// Contexts, imported memory, buffers and allocations that have not been given back.
int fake_cuda_alive();
}
