// Sways a tree that Espalier exported as glTF with `wind_weights`, in Unity: a Custom Function of Shader Graph, in the vertex
// stage, in object space. `uv2` and `uv3` are the nodes UV2 and UV3, as glTFast imports them: it turns the second number of
// each over. The measures are in the `extras` of the mesh, under `wind`.
// `blow` is where the wind blows to, level and in object space; as long as the angle by which it turns the trunk, in radians.
void EspalierWind_float(float3 position, float3 normal, float2 uv2, float2 uv3, float time, float3 blow,
                        float trunk_metres, float limb_metres, float trunk_hertz, float limb_hertz, out float3 moved)
{
    const float tau = 6.2831853;
    float trunk = uv2.x, limb = 1.0 - uv2.y, phase = uv3.x, flutter = 1.0 - uv3.y;
    float trunk_turn = 1.0 + 0.4 * sin(tau * trunk_hertz * time);
    float limb_turn = 1.0 + 0.8 * sin(tau * (limb_hertz * time + phase));
    moved = position + blow * (trunk * trunk_metres * trunk_turn + limb * limb_metres * limb_turn);
    moved += normal * flutter * 0.02 * sin(tau * (4.0 * time + 7.0 * phase) + position.x);
}
