// Embree's single-ray query, robust, on the rays that tools/bench_query.rs writes; prints its rate.
// Built by that benchmark where Embree 3 is installed; no part of the program.

#include <embree3/rtcore.h>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <vector>

static double thread_seconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

int main(int, char** argv) {
    std::FILE* file = std::fopen(argv[1], "rb");
    uint32_t count[3];
    if (!file || std::fread(count, 4, 3, file) != 3) return 1;
    const size_t corners = count[0], triangles = count[1], rays = count[2];
    std::vector<uint32_t> words(3 * corners + 4 * triangles + 7 * rays);
    if (std::fread(words.data(), 4, words.size(), file) != words.size()) return 1;
    const uint32_t* facet_of = &words[3 * corners + 3 * triangles];
    const float* ray = reinterpret_cast<const float*>(facet_of + triangles);
    const uint32_t* ours = facet_of + triangles + 6 * rays;

    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* p = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, corners);
    std::memcpy(p, words.data(), 12 * corners);
    p = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles);
    std::memcpy(p, words.data() + 3 * corners, 12 * triangles);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcCommitScene(scene);

    double best = std::numeric_limits<double>::infinity();
    size_t same = 0, none = 0;
    for (int run = 0; run < 50; ++run) {
        same = none = 0;
        const double start = thread_seconds();
        for (size_t i = 0; i < rays; ++i) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit hit;
            hit.ray = {ray[6 * i], ray[6 * i + 1], ray[6 * i + 2], 1e-5f, ray[6 * i + 3], ray[6 * i + 4],
                       ray[6 * i + 5], 0.0f, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
            hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &hit);
            if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) ++none;
            else same += facet_of[hit.hit.primID] == ours[i];
        }
        const double seconds = thread_seconds() - start;
        if (seconds < best) best = seconds;
    }
    std::printf("     Embree: %6.2f million queries/s (robust, one ray at a time); the same facet for %.3f %%, none for %zu\n",
                rays / best / 1e6, 100.0 * same / rays, none);
}
