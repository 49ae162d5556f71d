// Clusters as they are in buffers: kClusterTexels each where things move, else the first alone.
#ifndef SLANT_RESOURCES_CLUSTER_GLSL
#define SLANT_RESOURCES_CLUSTER_GLSL
#include "shared/layer_map.h"

Cluster clusterOf(vec4 slopes, vec4 velocities) {
    return Cluster(slopes.x, slopes.y, slopes.z, slopes.w, velocities.xy, velocities.zw);
}
vec4 slopesOf(Cluster cluster) {
    return vec4(cluster.slopeMin, cluster.slopeMax, cluster.level, cluster.depthRate);
}
vec4 velocitiesOf(Cluster cluster) {
    return vec4(cluster.velocityLow, cluster.velocityHigh);
}
#endif
