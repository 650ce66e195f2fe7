# What the WebAssembly build finds instead of Debian's packages: their headers alone. Not /usr/include itself, where the
# headers of the wrong C library lie, but a folder of links.
set(header_links ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${header_links})

# wasm_header_package(TARGET NAME PROOF): TARGET has the headers of the folder NAME, in which there is the file PROOF.
function(wasm_header_package target name proof)
  find_path(folder_of_${name} ${name}/${proof} PATHS /usr/include /usr/include/eigen3 NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${folder_of_${name}}/${name} ${header_links}/${name} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${header_links})
endfunction()

wasm_header_package(Eigen3::Eigen Eigen Dense)
wasm_header_package(nlohmann_json::nlohmann_json nlohmann json.hpp)
wasm_header_package(tomlplusplus::tomlplusplus toml++ toml.h)
