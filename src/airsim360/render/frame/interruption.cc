#include "airsim360/render/frame/interruption.h"

namespace airsim360 {

namespace {
thread_local const std::atomic<bool>* wanted_here = nullptr;
}

InterruptibleScope::InterruptibleScope(const std::atomic<bool>& wanted) { wanted_here = &wanted; }
InterruptibleScope::~InterruptibleScope() { wanted_here = nullptr; }

Interruption::Interruption() : wanted_(wanted_here) {}

}  // namespace airsim360
