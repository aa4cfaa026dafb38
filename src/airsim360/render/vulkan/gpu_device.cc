#include "airsim360/render/vulkan/gpu_device.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace internal {
namespace {

constexpr const char* kExtensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                       VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kHowToGetADriver = "install the driver of the GPU, or 'mesa-vulkan-drivers' from bookworm-backports (software)";

const char* NameOf(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of GPU memory: a smaller picture, fewer cameras in a batch or a smaller world would fit";
    case VK_ERROR_DEVICE_LOST:
      return "the GPU was lost (driver reset, time-out or hardware fault)";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialisation failed";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no Vulkan driver found";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_LAYER_KHRONOS_validation is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many allocations";
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_FRAGMENTATION:
      return "memory is fragmented";
    default:
      return nullptr;
  }
}

// All features that are asked of a device, chained.
struct Features {
  VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, nullptr, {}};
  VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, nullptr};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, nullptr};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structure{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
                                                             nullptr};
  VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR, nullptr};

  Features() {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &structure;
    structure.pNext = &pipeline;
  }
};

struct Need {
  const char* name;
  VkBool32 present;
};

std::array<Need, 6> NeedsOf(const Features& f) {
  return {{{"accelerationStructure", f.structure.accelerationStructure},
           {"rayTracingPipeline", f.pipeline.rayTracingPipeline},
           {"bufferDeviceAddress", f.v12.bufferDeviceAddress},
           {"scalarBlockLayout", f.v12.scalarBlockLayout},
           {"storageBuffer8BitAccess", f.v12.storageBuffer8BitAccess},
           {"storageBuffer16BitAccess", f.v11.storageBuffer16BitAccess}}};
}

std::string TooOld(uint32_t version) {
  return "the driver offers Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) +
         ", 1.2 is needed: update it";
}

std::vector<VkExtensionProperties> ExtensionsOf(VkPhysicalDevice physical) {
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return extensions;
}

bool Contains(const std::vector<VkExtensionProperties>& extensions, const char* name) {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

// What a device lacks; empty = nothing.
std::string Missing(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_2) return TooOld(properties.apiVersion);
  const std::vector<VkExtensionProperties> extensions = ExtensionsOf(physical);
  for (const char* name : kExtensions) {
    if (!Contains(extensions, name)) return std::string("no ") + name;
  }
  Features features;
  vkGetPhysicalDeviceFeatures2(physical, &features.core);
  for (const Need& need : NeedsOf(features)) {
    if (!need.present) return std::string("no ") + need.name;
  }
  return "";
}

GpuInfo Describe(VkPhysicalDevice physical, int index) {
  VkPhysicalDeviceIDProperties identity{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES, nullptr};
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, &identity};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  GpuInfo info;
  info.index = index;
  info.name = properties.properties.deviceName;
  info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  info.software = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  info.missing = Missing(physical);
  std::copy(std::begin(identity.deviceUUID), std::end(identity.deviceUUID), info.uuid.begin());
  info.shares_memory = Contains(ExtensionsOf(physical), VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME);
  return info;
}

std::vector<VkPhysicalDevice> PhysicalDevices(VkInstance instance) {
  uint32_t count = 0;
  CheckVk(vkEnumeratePhysicalDevices(instance, &count, nullptr), "listing GPUs");
  std::vector<VkPhysicalDevice> devices(count);
  CheckVk(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "listing GPUs");
  devices.resize(count);
  return devices;
}

VKAPI_ATTR VkBool32 VKAPI_CALL KeepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* list) {
  static_cast<std::vector<std::string>*>(list)->push_back(data->pMessage);
  return VK_FALSE;
}

VkInstance MakeInstance(bool validate, GpuFault fault = GpuFault::kNone) {
  const VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "airsim360", 1, "airsim360", 1, VK_API_VERSION_1_2};
  constexpr VkValidationFeatureEnableEXT kSync = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  const VkValidationFeaturesEXT checks{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, nullptr, 1, &kSync, 0, nullptr};
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr};
  info.pApplicationInfo = &application;
  if (validate) {
    info.pNext = &checks;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  VkInstance instance;
  const VkResult result = fault == GpuFault::kNoVulkan ? VK_ERROR_INCOMPATIBLE_DRIVER : vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw RuntimeError(std::string("no Vulkan driver found; ") + kHowToGetADriver);
  CheckVk(result, "opening Vulkan");
  return instance;
}

// Hardware before software, a GPU with memory of its own before one that shares the CPU's.
int Rank(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 0;
    default:
      return 1;
  }
}

// The device asked for, or the best: of equal ones the first.
VkPhysicalDevice Choose(VkInstance instance, int wanted, GpuFault fault, GpuInfo& info) {
  const std::vector<VkPhysicalDevice> devices = PhysicalDevices(instance);
  if (devices.empty()) throw RuntimeError(std::string("Vulkan knows no device; ") + kHowToGetADriver);
  std::string list, reasons;
  int best = -1;
  std::vector<GpuInfo> all;
  for (size_t i = 0; i < devices.size(); ++i) {
    all.push_back(Describe(devices[i], static_cast<int>(i)));
    if (fault == GpuFault::kOldDriver) all.back().missing = TooOld(VK_API_VERSION_1_1);
    const GpuInfo& d = all.back();
    list += (i ? ", " : "") + std::to_string(i) + " = " + d.name;
    reasons += (i ? "; " : "") + d.name + ": " + d.missing;
    if (d.missing.empty() && (best < 0 || Rank(devices[i]) > Rank(devices[static_cast<size_t>(best)]))) best = static_cast<int>(i);
  }
  if (wanted >= static_cast<int>(devices.size()))
    throw InputError("--gpu: there is no GPU " + std::to_string(wanted) + " (GPUs: " + list + ")");
  if (wanted >= 0 && !all[static_cast<size_t>(wanted)].missing.empty()) {
    const GpuInfo& d = all[static_cast<size_t>(wanted)];
    throw RuntimeError("GPU " + std::to_string(wanted) + " (" + d.name + ", " + d.driver + ") cannot trace rays: " + d.missing);
  }
  if (wanted < 0 && best < 0) throw RuntimeError("no GPU here can trace rays: " + reasons);
  const auto chosen = static_cast<size_t>(wanted >= 0 ? wanted : best);
  info = all[chosen];
  return devices[chosen];
}

}  // namespace

void CheckVk(VkResult result, const char* what) {
  if (result >= 0) return;
  const char* name = NameOf(result);
  throw RuntimeError(std::string("GPU: ") + what + ": " + (name ? name : ("Vulkan error " + std::to_string(result)).c_str()));
}

GpuDevice::GpuDevice(const GpuOptions& options) : fault_(options.fault) {
  try {
    OpenInstance(options.validate);
    const VkPhysicalDevice physical = Choose(instance_, options.gpu, fault_, info_);
    discrete_ = options.discrete || !info_.software;
    ReadLimits(physical);
    OpenDevice(physical);
    LoadFunctions();
  } catch (...) {
    Close();
    throw;
  }
}

GpuDevice::~GpuDevice() { Close(); }

void GpuDevice::Close() {
  if (device_ != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device_);
    if (pool_ != VK_NULL_HANDLE) vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (instance_ == VK_NULL_HANDLE) return;
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy =
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

void GpuDevice::OpenInstance(bool validate) {
  instance_ = MakeInstance(validate, fault_);
  if (!validate) return;
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT, nullptr};
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = KeepMessage;
  info.pUserData = &messages_;
  const auto create =
      reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  CheckVk(create(instance_, &info, nullptr, &messenger_), "listening to validation");
}

// A family that computes (hardware has one that does everything at index 0), and one that only copies.
void GpuDevice::ChooseQueues(VkPhysicalDevice physical) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  while (queue_family_ < count && !(families[queue_family_].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++queue_family_;
  if (queue_family_ == count) throw RuntimeError("GPU '" + info_.name + "' has no compute queue");
  copy_family_ = queue_family_;
  for (uint32_t i = count; i-- > 0;) {
    constexpr VkQueueFlags kMore = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if ((families[i].queueFlags & VK_QUEUE_TRANSFER_BIT) && !(families[i].queueFlags & kMore)) copy_family_ = i;
  }
  const uint32_t bits = families[queue_family_].timestampValidBits;
  timestamp_mask_ = bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1;
}

void GpuDevice::OpenDevice(VkPhysicalDevice physical) {
  ChooseQueues(physical);
  if (timestamp_mask_ == 0) timestamp_period_ns_ = 0;
  Features features;
  features.v11.storageBuffer16BitAccess = VK_TRUE;
  features.v12.bufferDeviceAddress = features.v12.scalarBlockLayout = VK_TRUE;
  features.v12.storageBuffer8BitAccess = VK_TRUE;
  features.structure.accelerationStructure = features.pipeline.rayTracingPipeline = VK_TRUE;
  const float priority = 1;
  VkDeviceQueueCreateInfo queues[2] = {{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, queue_family_, 1, &priority},
                                       {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, copy_family_, 1, &priority}};
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.core};
  info.queueCreateInfoCount = copy_family_ != queue_family_ ? 2 : 1;
  info.pQueueCreateInfos = queues;
  std::vector<const char*> extensions(std::begin(kExtensions), std::end(kExtensions));
  if (info_.shares_memory) extensions.push_back(VK_KHR_EXTERNAL_MEMORY_FD_EXTENSION_NAME);
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  CheckVk(vkCreateDevice(physical, &info, nullptr, &device_), "opening the device");
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
  vkGetDeviceQueue(device_, copy_family_, 0, &copy_queue_);
  const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                     queue_family_};
  CheckVk(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "making a command pool");
}

void GpuDevice::ReadLimits(VkPhysicalDevice physical) {
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
  VkPhysicalDeviceVulkan11Properties v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES, &structure_limits_};
  structure_limits_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
  structure_limits_.pNext = &pipeline_limits_;
  pipeline_limits_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &v11, {}};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  most_memory_ = v11.maxMemoryAllocationSize;
  timestamp_period_ns_ = properties.properties.limits.timestampPeriod;
}

void GpuDevice::LoadFunctions() {
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device_, name));
    if (function == nullptr) throw RuntimeError(std::string("GPU driver lacks ") + name);
  };
  load(rt_.create_structure, "vkCreateAccelerationStructureKHR");
  load(rt_.destroy_structure, "vkDestroyAccelerationStructureKHR");
  load(rt_.build_sizes, "vkGetAccelerationStructureBuildSizesKHR");
  load(rt_.structure_address, "vkGetAccelerationStructureDeviceAddressKHR");
  load(rt_.build, "vkCmdBuildAccelerationStructuresKHR");
  load(rt_.copy, "vkCmdCopyAccelerationStructureKHR");
  load(rt_.write_properties, "vkCmdWriteAccelerationStructuresPropertiesKHR");
  load(rt_.create_pipelines, "vkCreateRayTracingPipelinesKHR");
  load(rt_.group_handles, "vkGetRayTracingShaderGroupHandlesKHR");
  load(rt_.trace_rays, "vkCmdTraceRaysKHR");
}

void GpuDevice::Run(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                             VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  CheckVk(vkAllocateCommandBuffers(device_, &allocate, &commands), "making commands");
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                       nullptr};
  CheckVk(vkBeginCommandBuffer(commands, &begin), "recording");
  record(commands);
  const VkMemoryBarrier all{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT,
                            VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &all, 0, nullptr, 0,
                       nullptr);
  CheckVk(vkEndCommandBuffer(commands), "recording");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  CheckVk(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "starting work");
  CheckVk(vkQueueWaitIdle(queue_), "waiting for the GPU");
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
}

}  // namespace internal

bool MachineHasGpu() {
  std::error_code none;
  for (const char* file : {"/dev/nvidiactl", "/dev/dxg"}) {
    if (std::filesystem::exists(file, none)) return true;
  }
  for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", none)) {
    if (entry.path().filename().string().starts_with("renderD")) return true;
  }
  return false;
}

std::vector<GpuInfo> ListGpus(std::string* why) {
  std::vector<GpuInfo> list;
  VkInstance instance = VK_NULL_HANDLE;
  try {
    instance = internal::MakeInstance(false);
    for (VkPhysicalDevice device : internal::PhysicalDevices(instance))
      list.push_back(internal::Describe(device, static_cast<int>(list.size())));
    if (list.empty() && why) *why = "Vulkan knows no device";
  } catch (const RuntimeError& error) {
    if (why) *why = error.what();
  }
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
  return list;
}

}  // namespace airsim360
