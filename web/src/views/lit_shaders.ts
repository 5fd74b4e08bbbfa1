// The shaders of the lit object: where each pixel lies, the model or what the engine says of it, and the mean of passes on the screen.

import model from "../../../tables/formats/glsl/he_torrance.glsl?raw";

export const size = 320; // pixels of a side

// What all programs of the object share: its shape, the lamp and the sky.
const world = `#version 300 es
precision highp float;
precision highp int;
uniform int shape, pass_index, grid;   // grid: pixels of a side
uniform vec3 lamp;                     // towards it
uniform sampler2D before;

const float PI = 3.14159265;
const float LAMP_COS = 0.9998;         // half angle 1.15 degrees
const float LAMP_SOLID_ANGLE = 6.2831853 * (1.0 - LAMP_COS);
const float LAMP = 0.8 * PI;           // irradiance facing it
const vec3 TO_VIEWER = vec3(0.0, 0.0, 1.0);

uint state;
float uniform01() {
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    return float(word >> 8u) / 16777216.0;
}

// Brightness of a sky that is lit from above, with a window behind the viewer; white.
float sky(vec3 d) {
    float s = mix(0.10, 0.55, smoothstep(-0.3, 0.9, d.y));
    vec3 w = normalize(vec3(-0.75, 0.55, 0.75));
    float a = max(abs(dot(d, normalize(vec3(0.707, 0.0, 0.707)))), abs(d.y - 0.45)) ;
    return s + (dot(d, w) > 0.0 && a < 0.32 ? 1.6 : 0.0);
}

// What a mirror shows of both.
float mirrored(vec3 normal) {
    vec3 d = reflect(-TO_VIEWER, normal);
    return sky(d) + (dot(d, lamp) > LAMP_COS ? LAMP / LAMP_SOLID_ANGLE : 0.0);
}

bool hit(vec2 p, out vec3 normal) {
    if (shape == 0) {
        float r2 = dot(p, p) / 0.81;
        if (r2 >= 1.0) return false;
        normal = vec3(p / 0.9, sqrt(1.0 - r2));
        return true;
    }
    if (shape == 1) {
        // a plate that lies before the viewer, tilted back
        if (abs(p.x) > 0.85 || abs(p.y) > 0.55) return false;
        normal = normalize(vec3(-0.35 * p.x, 0.55 - 0.35 * p.y, 1.0));
        return true;
    }
    if (abs(p.x) > 0.62 || abs(p.y) > 0.85) return false;
    float x = p.x / 0.62;
    normal = vec3(x, 0.0, sqrt(1.0 - x * x));
    return true;
}

// A point of the object in this pixel, and viewer and lamp in the frame of its surface, whose x lies level.
struct Spot {
    bool seen;
    vec3 wo, wl;
    mat3 frame;   // tangent, bitangent, normal
};
Spot spot() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    state = uint(pixel.x) * 1973u + uint(pixel.y) * 9277u + uint(pass_index) * 26699u + 1u;
    uniform01();
    vec2 p = (gl_FragCoord.xy + vec2(uniform01(), uniform01()) - 0.5) / (0.5 * float(grid)) - 1.0;
    Spot s;
    vec3 normal;
    s.seen = hit(p, normal);
    if (!s.seen) return s;
    vec3 tangent = normalize(abs(normal.y) < 0.9999 ? cross(vec3(0.0, 1.0, 0.0), normal) : vec3(1.0, 0.0, 0.0));
    s.frame = mat3(tangent, cross(normal, tangent), normal);
    s.wo = TO_VIEWER * s.frame;
    s.wl = lamp * s.frame;
    s.seen = s.wo.z > 0.0;
    return s;
}

// The mean of this pass and those before.
vec4 averaged(vec3 rgb, bool seen) {
    vec4 sum = seen ? vec4(max(rgb, vec3(0.0)), 1.0) : vec4(0.0);
    vec4 old = pass_index > 0 ? texelFetch(before, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
    return (old * float(pass_index) + sum) / float(pass_index + 1);
}
`;

// The model he of a Gaussian surface, wholly in the shader.
export const byShader = `${world}
${model}
const int COUNT = 8;
uniform float wavelength[COUNT], n[COUNT], k[COUNT];
uniform vec3 weight[COUNT];
uniform float sigma0, tau, albedo;
uniform int count;
out vec4 colour;

vec3 brdf(vec3 wi, vec3 wo) {
    HtsPair pair = hts_pair(sigma0, tau, wi, wo);
    vec3 rgb = vec3(0.0);
    for (int w = 0; w < COUNT; ++w) {
        if (w >= count) break;
        rgb += weight[w] * (hts_pair_brdf(pair, wavelength[w], n[w], k[w]) + albedo / HTS_PI);
    }
    return rgb;
}

void main() {
    Spot s = spot();
    vec3 rgb = vec3(0.0);
    if (s.seen) {
        if (s.wl.z > 0.0) rgb += brdf(s.wl, s.wo) * s.wl.z * LAMP;
        for (int w = 0; w < COUNT; ++w) {
            if (w >= count) break;
            rgb += weight[w] * hts_he_specular(s.wo, wavelength[w], sigma0, tau, n[w], k[w]) * mirrored(s.frame[2]);
        }
        // the sky is drawn at one wavelength and evaluated at all
        int chosen = min(int(uniform01() * float(count)), count - 1);
        HtsDraw d = hts_he_sample(s.wo, vec3(uniform01(), uniform01(), uniform01()), wavelength[chosen], sigma0, tau,
                                  n[chosen], k[chosen], albedo);
        if (!d.specular && d.pdf > 0.0) {
            // one density for all wavelengths: the mean of those by which any of them would have drawn it
            float density = 0.0;
            for (int w = 0; w < COUNT; ++w) {
                if (w >= count) break;
                density += hts_he_pdf(s.wo, d.direction, wavelength[w], sigma0, tau, n[w], k[w], albedo) / float(count);
            }
            rgb += brdf(d.direction, s.wo) * d.direction.z / density * sky(s.frame * d.direction);
        }
    }
    colour = averaged(rgb, s.seen);
}
`;

// Every other surface is evaluated by the engine, pixel by pixel: what it must be told of each …
export const spots = `${world}
layout(location = 0) out vec4 viewer;
layout(location = 1) out vec4 light;
layout(location = 2) out vec4 chance;
void main() {
    Spot s = spot();
    viewer = vec4(s.seen ? s.wo : vec3(0.0), s.seen ? 1.0 : 0.0);
    light = vec4(s.seen ? s.wl : vec3(0.0), 0.0);
    chance = vec4(uniform01(), uniform01(), uniform01(), 0.0);
}
`;
// … and what becomes of its answers. The fourth numbers are a direction drawn from the diffuse terms.
export const composed = `${world}
uniform sampler2D lobe, specular, drawn;
out vec4 colour;
void main() {
    Spot s = spot();
    vec3 rgb = vec3(0.0);
    if (s.seen) {
        ivec2 at = ivec2(gl_FragCoord.xy);
        vec4 a = texelFetch(lobe, at, 0), b = texelFetch(specular, at, 0), c = texelFetch(drawn, at, 0);
        rgb = a.rgb * max(s.wl.z, 0.0) * LAMP + b.rgb * mirrored(s.frame[2]);
        if (c.a > 0.0) rgb += c.rgb * sky(s.frame * vec3(a.a, b.a, c.a));
    }
    colour = averaged(rgb, s.seen);
}
`;

export const screen = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec3 ground;
uniform int grid;
out vec4 colour;
void main() {
    vec4 c = texelFetch(image, ivec2(gl_FragCoord.xy) * grid / ${size}, 0);
    vec3 v = c.rgb;
    float y = dot(v, vec3(0.2126, 0.7152, 0.0722));
    v *= (1.0 + y / 16.0) / (1.0 + y);                       // Reinhard's curve, white at 4
    v = mix(12.92 * v, 1.055 * pow(max(v, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
    colour = vec4(mix(ground, v, c.a), 1.0);
}
`;

export const corners = `#version 300 es
in vec2 corner;
void main() { gl_Position = vec4(corner, 0.0, 1.0); }
`;
