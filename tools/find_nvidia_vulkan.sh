# To be sourced: containers often hold NVIDIA's Vulkan driver where the loader does not look. Sets VK_DRIVER_FILES then, and
# brings the X libraries that the driver is linked with.
if [ -e /dev/nvidiactl ] && [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]; then
  if [ "$(id -u)" -eq 0 ] && ! ldconfig -p | grep -q 'libXext\.so\.6'; then
    apt-get install -y -qq --no-install-recommends libx11-6 libxext6 >/dev/null 2>&1 || echo "could not install libx11-6, libxext6" >&2
  fi
  if ! ls /etc/vulkan/icd.d/nvidia_icd*.json /usr/share/vulkan/icd.d/nvidia_icd*.json >/dev/null 2>&1; then
    for file in /usr/local/nvidia/share/vulkan/icd.d/nvidia_icd.json /usr/local/share/vulkan/icd.d/nvidia_icd.json; do
      [ -e "$file" ] && VK_DRIVER_FILES="$file" && export VK_DRIVER_FILES && echo "driver: $file" && break
    done
    # No file says where it is, but the library is there.
    for library in libGLX_nvidia.so.0 libEGL_nvidia.so.0; do
      [ -z "${VK_DRIVER_FILES:-}" ] || break
      ldconfig -p | grep -q "$library" || continue
      VK_DRIVER_FILES="$(mktemp /tmp/nvidia_icd_XXXXXX.json)"
      printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" >"$VK_DRIVER_FILES"
      export VK_DRIVER_FILES
      echo "driver: $library"
    done
  fi
fi
