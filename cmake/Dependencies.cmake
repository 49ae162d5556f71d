# Everything here is a Debian 12 package (packages.txt).

find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Vulkan REQUIRED)
find_package(CLI11 REQUIRED)

# Embree 4 where there is one, else Embree 3 (host/trace/embree.h hides the difference).
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
    find_package(embree 3.13 REQUIRED)
endif()
set(SLANT_EMBREE_TARGET embree)
