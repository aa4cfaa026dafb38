# The page becomes part of the library.
set(view_dir ${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/view)
file(GLOB view_page CONFIGURE_DEPENDS ${view_dir}/page/*)
list(JOIN view_page "|" view_page_list)
set(view_page_source ${CMAKE_CURRENT_BINARY_DIR}/view_page.cc)
add_custom_command(
  OUTPUT ${view_page_source}
  COMMAND ${CMAKE_COMMAND} -DOUT=${view_page_source} -DFILES=${view_page_list} -P ${view_dir}/embed.cmake
  DEPENDS ${view_page} ${view_dir}/embed.cmake
  VERBATIM)
target_sources(airsim360_view PRIVATE ${view_page_source})
