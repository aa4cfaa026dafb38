#include "airsim360/rpc/wire/shared_memory.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

namespace airsim360 {
namespace {

// No TCP port has this number: the names of servers that run are not met.
const int kPort = 100000 + static_cast<int>(::getpid());

int MakeMemory(size_t size, int seals) {
  const int fd = ::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  EXPECT_EQ(::ftruncate(fd, static_cast<off_t>(size)), 0);
  EXPECT_TRUE(seals == 0 || ::fcntl(fd, F_ADD_SEALS, seals) == 0);
  return fd;
}

// One end of a loan, by hand.
struct Lender {
  int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  Lender() {
    sockaddr_un where{};
    where.sun_family = AF_UNIX;
    const std::string name = "airsim360/" + std::to_string(kPort);
    std::memcpy(where.sun_path + 1, name.data(), name.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    EXPECT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&where), size), 0);
  }
  ~Lender() { ::close(socket); }

  void Send(int fd) {
    char byte = 0;
    iovec piece{&byte, 1};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof fd)] = {};
    msghdr message{};
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* part = CMSG_FIRSTHDR(&message);
    part->cmsg_level = SOL_SOCKET;
    part->cmsg_type = SCM_RIGHTS;
    part->cmsg_len = CMSG_LEN(sizeof fd);
    std::memcpy(CMSG_DATA(part), &fd, sizeof fd);
    EXPECT_EQ(::sendmsg(socket, &message, MSG_NOSIGNAL), 1);
  }
  // 0: refused, the connection is closed.
  uint64_t Token() {
    uint64_t token = 0;
    return ::recv(socket, &token, sizeof token, MSG_WAITALL) == sizeof token ? token : 0;
  }
};

TEST(SharedMemory, OnlyWhatCannotShrinkIsMapped) {
  EXPECT_NE(SharedMemory::Map(MakeMemory(4096, F_SEAL_SHRINK)), nullptr);
  EXPECT_EQ(SharedMemory::Map(MakeMemory(4096, 0)), nullptr);
  EXPECT_EQ(SharedMemory::Map(MakeMemory(4096, F_SEAL_GROW)), nullptr);
  EXPECT_EQ(SharedMemory::Map(MakeMemory(0, F_SEAL_SHRINK)), nullptr);
  EXPECT_EQ(SharedMemory::Map(MakeMemory(SharedMemory::kMost + 1, F_SEAL_SHRINK)), nullptr);
  EXPECT_EQ(SharedMemory::Map(::open("/dev/zero", O_RDWR | O_CLOEXEC)), nullptr);
  EXPECT_EQ(SharedMemory::Map(MakeMemory(4096, F_SEAL_SHRINK | F_SEAL_WRITE)), nullptr);
}

TEST(LentRegion, IsFilledFrontToBackAndNeverBeyond) {
  const auto memory = SharedMemory::Map(MakeMemory(8192, F_SEAL_SHRINK));
  for (const auto& [offset, size] : {std::pair<uint64_t, uint64_t>{0, 8193}, {8256, 0}, {64, UINT64_MAX}, {UINT64_MAX, 2}, {4, 64}})
    EXPECT_THROW(LentRegion(memory, offset, size), std::invalid_argument) << offset << " " << size;
  LentRegion region(memory, 128, 1000);
  const auto a = region.Take(100), b = region.Take(800), c = region.Take(100);
  ASSERT_NE(a, nullptr);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(c, nullptr);
  EXPECT_EQ(region.OffsetOf(a.get()), 128u);
  EXPECT_EQ(region.OffsetOf(b.get()), 128u + 128);
  EXPECT_TRUE(region.Has(b.get()));
  const char other = 0;
  EXPECT_FALSE(region.Has(&other));
  EXPECT_EQ(region.wanted(), 128u + 832 + 128);
}

TEST(MemoryLoans, LastAsLongAsTheirConnectionAndAreWrittenByBothSides) {
  MemoryLoans loans;
  loans.Listen(kPort);
  std::shared_ptr<SharedMemory> kept;
  {
    Lender lender;
    const int fd = MakeMemory(4096, F_SEAL_SHRINK);
    char* mine = static_cast<char*>(::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0));
    lender.Send(fd);
    ::close(fd);
    const uint64_t token = lender.Token();
    ASSERT_NE(token, 0u);
    kept = loans.Find(token);
    kept->data()[7] = 'x';
    EXPECT_EQ(mine[7], 'x');
    ::munmap(mine, 4096);
    EXPECT_THROW(loans.Find(token + 1), std::invalid_argument);
  }
  while (loans.count() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kept->data()[8] = 'y';  // whoever writes a picture still may
}

TEST(MemoryLoans, AreRefusedToOthersWithoutHarm) {
  MemoryLoans loans;
  loans.Listen(kPort);
  Lender unsealed, twice;
  int fd = MakeMemory(4096, 0);
  unsealed.Send(fd);
  ::close(fd);
  EXPECT_EQ(unsealed.Token(), 0u);
  fd = MakeMemory(4096, F_SEAL_SHRINK);
  twice.Send(fd);
  EXPECT_NE(twice.Token(), 0u);
  twice.Send(fd);
  ::close(fd);
  EXPECT_EQ(twice.Token(), 0u);
  // More memory than all clients together may lend.
  Lender large[5];
  int lent = 0;
  for (Lender& lender : large) {
    fd = MakeMemory(SharedMemory::kMost, F_SEAL_SHRINK);
    lender.Send(fd);
    ::close(fd);
    lent += lender.Token() != 0;
  }
  EXPECT_EQ(lent, 4);
  MemoryLoans second;  // the name is taken
  second.Listen(kPort);
  EXPECT_EQ(second.count(), 0u);
}

}  // namespace
}  // namespace airsim360
