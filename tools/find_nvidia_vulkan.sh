# To be sourced: containers often hold NVIDIA's Vulkan driver where the loader does not look, or lack the X libraries that its usual
# entry is linked with. Sets VK_DRIVER_FILES then.
if [ -e /dev/nvidiactl ] && [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]; then
  if [ "$(id -u)" -eq 0 ] && ! ldconfig -p | grep -q 'libXext\.so\.6'; then
    apt-get install -y -qq --no-install-recommends libx11-6 libxext6 >/dev/null 2>&1 || true
  fi
  # An entry of the loader's: libGLX_nvidia.so.0 answers only with the X libraries, libEGL_nvidia.so.0, the same driver, without them.
  library=libGLX_nvidia.so.0
  ldconfig -p | grep -q 'libXext\.so\.6' || library=libEGL_nvidia.so.0
  found="$(ls /etc/vulkan/icd.d/nvidia_icd*.json /usr/share/vulkan/icd.d/nvidia_icd*.json 2>/dev/null | head -1)"
  if ! { [ -n "$found" ] && grep -q "$library" "$found"; } && ldconfig -p | grep -q "$library"; then
    VK_DRIVER_FILES="$(mktemp /tmp/nvidia_icd_XXXXXX.json)"
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" >"$VK_DRIVER_FILES"
    export VK_DRIVER_FILES
    echo "driver: $library"
  fi
fi
