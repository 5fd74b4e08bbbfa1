// ---- the model, for any surface, wavelength and index ------------------------------------------------------
// hts compiles and tests the same text, of GLSL ES 3.00 and C++ alike.

const float HTS_PI = 3.14159265f;

// W_0(x), the solution of W exp(W) = x, for x >= 0. Error: 1e-6, relative.
float hts_lambert(float x) {
    if (x < 1.0e-3f) return x * (1.0f - x * (1.0f - 1.5f * x));
    float l = log(1.0f + x);
    float w = l * (1.0f - log(1.0f + l) / (2.0f + l));
    w = w / (1.0f + w) * (1.0f + log(x / w));
    return w / (1.0f + w) * (1.0f + log(x / w));
}

// ln of g Phi over its saddle point, for x = 12/g - 1 and z in -1 ... 1: 35 coefficients, 140 bytes.
// Error: 2.2e-4.
float hts_phi_correction(float x, float z) {
    float s = ((((-0.00919355f) * x - 0.00990550f) * x - 0.00897507f) * x + 0.00888507f) * x + 0.0110556f;
    s = s * z + ((((0.00284042f * x + 0.0200209f) * x - 0.00714056f) * x - 0.0211273f) * x - 0.00168443f);
    s = s * z + ((((0.00267422f * x + 0.00933791f) * x + 0.0277862f) * x + 0.00110570f) * x - 0.0102298f);
    s = s * z + ((((0.00339076f * x - 0.0186830f) * x - 0.00580835f) * x + 0.00640527f) * x - 0.00144575f);
    s = s * z + ((((0.00115564f * x - 0.00380772f) * x - 0.00683966f) * x + 0.0284955f) * x + 0.0283506f);
    s = s * z + ((((-0.00161852f * x + 0.00390122f) * x + 0.00287880f) * x - 0.0465224f) * x - 0.0456170f);
    return s * z + ((((-8.04695e-05f * x + 2.94156e-05f) * x - 0.000934222f) * x + 0.0190149f) * x + 0.0200773f);
}

// Phi(g, t) = exp(-g) sum g^m/(m! m) exp(-t/m) [He91 (78)]. Below g = 6 by its terms, above from its saddle point
// m = g exp(d), where d exp(2 d) = t/g^2; the exponent is stationary there, so an error of d hardly counts.
// Error: 4e-4 where Phi > 1e-30; below it is only small.
float hts_phi(float g, float t) {
    if (!(g > 0.0f)) return 0.0f;
    if (g < 6.0f) {
        float power = 1.0f;
        float sum = 0.0f;
        for (int i = 1; i <= 40; ++i) {
            float m = float(i);
            power *= g / m;
            float term = power / m * exp(-t / m);
            sum += term;
            if (m > g && term < 2.0e-5f * sum) break;
        }
        return exp(-g) * sum;
    }
    float s = t / g / g;
    float d = 0.5f * hts_lambert(2.0f * s);
    float below = exp(-d);
    float bend = d - 1.0f + below;
    if (d < 0.3f) bend = d * d * (0.5f - d * (0.16666667f - d * (0.041666667f - d * 0.0083333333f)));
    float exponent = -g / below * (bend + s * below * below);
    float z = min(d / (0.3f + d) * (2.0f / 0.842f) - 1.0f, 1.0f);
    return exp(exponent + hts_phi_correction(12.0f / g - 1.0f, z)) * below / (g * sqrt(1.0f + 2.0f * d));
}

// |F|^2 for unpolarised light, index n + ik, cosine c [He91 (44)]; in forms that do not cancel as n -> 1.
float hts_fresnel(float c, float n, float k) {
    if (c <= 0.0f) return 1.0f;
    float sine2 = (1.0f - c) * (1.0f + c);
    float excess_re = (n - 1.0f) * (n + 1.0f) - k * k;
    float square_re = (n - k) * (n + k);
    float im = 2.0f * n * k;
    // r = sqrt(N^2 - sin^2)
    float under_re = square_re - sine2;
    if (abs(excess_re) + abs(im) < 0.5f) under_re = excess_re + c * c;
    float size = sqrt(under_re * under_re + im * im);
    float root = sqrt(0.5f * (size + abs(under_re)));
    float r_re = root;
    float r_im = 0.0f;
    if (root > 0.0f) r_im = 0.5f * im / root;
    if (under_re < 0.0f) {
        r_re = r_im;
        r_im = root;
    }
    float excess2 = excess_re * excess_re + im * im;
    float s2 = (c + r_re) * (c + r_re) + r_im * r_im;
    float p_re = square_re * c + r_re;
    float p_im = im * c + r_im;
    float p2 = p_re * p_re + p_im * p_im;
    float t_re = c * c * square_re - sine2;
    float t_im = c * c * im;
    return 0.5f * excess2 * (1.0f / s2 / s2 + (t_re * t_re + t_im * t_im) / p2 / p2);
}

// What a direction sees of a surface of slope width 2 sigma0/tau.
struct HtsView {
    float obstruction;              // K of the direction [He91 (81)]
    float shadowing;                // S_1 [He91 (24)]
    float shadowing_over_cosine;    // finite at the horizon of a rough surface
};

HtsView hts_view(float slope_width, vec3 w) {
    HtsView v;
    float cosine = max(w.z, 0.0f);
    float sine = sqrt(w.x * w.x + w.y * w.y);
    float width = slope_width * sine;
    v.obstruction = 0.0f;
    v.shadowing = 1.0f;
    v.shadowing_over_cosine = 1.0f / max(cosine, 1.0e-20f);
    if (!(cosine < 9.0f * width)) return v;
    float c = cosine / width;
    float e = exp(-c * c);
    float q = 1.0f / (1.0f + 0.3275911f * c);
    float complement =
        e * q * (0.254829592f + q * (-0.284496736f + q * (1.421413741f + q * (-1.453152027f + q * 1.061405429f))));
    v.obstruction = complement * sine / max(cosine, 1.0e-20f);
    float masked = 0.5f * width * (0.56418958f * e - c * complement);
    v.shadowing_over_cosine = (1.0f - 0.5f * complement) / (cosine + masked);
    v.shadowing = cosine * v.shadowing_over_cosine;
    return v;
}

// sigma/sigma0, the share of the roughness that is lit and seen [He91 (80)].
float hts_visible_roughness(float obstruction) {
    return 1.0f / sqrt(1.0f + hts_lambert(min(obstruction * obstruction, 1.0e18f) / (8.0f * HTS_PI)));
}

// What a pair of directions contributes, whatever the wavelength; lengths in micrometres.
struct HtsPair {
    float cos_d;           // cosine of the angle of incidence on the facet that mirrors one into the other
    float phase;           // g lambda^2
    float argument;        // t lambda^2
    float factor;          // of the lobe, times lambda^2
};

// wi towards the light, wo towards the viewer, unit vectors about the normal (0, 0, 1).
HtsPair hts_pair(float sigma0, float tau, vec3 wi, vec3 wo) {
    HtsPair p;
    float slope_width = 2.0f * sigma0 / tau;
    HtsView i = hts_view(slope_width, wi);
    HtsView o = hts_view(slope_width, wo);
    float x = wi.x + wo.x;
    float y = wi.y + wo.y;
    float z = wi.z + wo.z;
    float horizontal2 = x * x + y * y;
    float all2 = horizontal2 + z * z;
    float sigma = sigma0 * hts_visible_roughness(i.obstruction + o.obstruction);
    float root_geometry = all2 / z;
    p.cos_d = min(0.5f * sqrt(all2), 1.0f);
    p.phase = 4.0f * HTS_PI * HTS_PI * sigma * sigma * z * z;
    p.argument = HTS_PI * HTS_PI * tau * tau * horizontal2;
    p.factor = 0.25f * HTS_PI * tau * tau * root_geometry * root_geometry * i.shadowing_over_cosine *
               o.shadowing_over_cosine;
    return p;
}

// The directional-diffuse term [1/sr] of a pair at a wavelength [um].
float hts_pair_brdf(HtsPair p, float wavelength, float n, float k) {
    float inverse2 = 1.0f / (wavelength * wavelength);
    return hts_fresnel(p.cos_d, n, k) * p.factor * inverse2 * hts_phi(p.phase * inverse2, p.argument * inverse2);
}

// BRDF of both diffuse terms [1/sr], without the cosine; 0 below the horizon.
float hts_he_brdf(vec3 wi, vec3 wo, float wavelength, float sigma0, float tau, float n, float k, float albedo) {
    if (wi.z <= 0.0f || wo.z <= 0.0f) return 0.0f;
    return hts_pair_brdf(hts_pair(sigma0, tau, wi, wo), wavelength, n, k) + albedo / HTS_PI;
}

// Reflectance into the mirror direction alone [1], a delta: no BRDF value.
float hts_he_specular(vec3 wi, float wavelength, float sigma0, float tau, float n, float k) {
    if (wi.z <= 0.0f) return 0.0f;
    HtsView v = hts_view(2.0f * sigma0 / tau, wi);
    float phase = 4.0f * HTS_PI * wi.z * sigma0 * hts_visible_roughness(2.0f * v.obstruction) / wavelength;
    return hts_fresnel(wi.z, n, k) * exp(-phase * phase) * v.shadowing * v.shadowing;
}

// ---- sampling ----------------------------------------------------------------------------------------------
// Facets of Gaussian slopes, for rough surfaces; a beam of Gaussian width in direction cosines, for smooth ones;
// a cosine lobe, so that no weight is large; the mirror direction.

struct HtsMixture {
    float specular;         // probabilities; the rest is the cosine lobe's
    float facets;
    float beam;
    float facet_width2;     // squared, of slopes
    float beam_width2;      // squared, of direction cosines
};

HtsMixture hts_mixture(vec3 wi, float wavelength, float sigma0, float tau, float n, float k, float albedo) {
    HtsMixture m;
    HtsView v = hts_view(2.0f * sigma0 / tau, wi);
    float phase = 4.0f * HTS_PI * wi.z * sigma0 * hts_visible_roughness(2.0f * v.obstruction) / wavelength;
    float g = phase * phase;
    float mirror = hts_fresnel(wi.z, n, k) * v.shadowing * v.shadowing;
    float specular = mirror * exp(-g);
    float lobe = 0.02f + mirror - specular;
    float total = specular + lobe + albedo;
    m.specular = specular / total;
    float diffuse = 0.9f * lobe / total;
    m.facets = diffuse * g / (1.0f + g);
    m.beam = diffuse / (1.0f + g);
    m.facet_width2 = 4.0f * sigma0 * sigma0 / (tau * tau) * (1.1f + 1.0f / sqrt(0.1f + g));
    m.beam_width2 = (1.0f + g) * wavelength * wavelength / (HTS_PI * HTS_PI * tau * tau);
    return m;
}

float hts_mixture_pdf(HtsMixture m, vec3 wi, vec3 wo) {
    float x = wi.x + wo.x;
    float y = wi.y + wo.y;
    float z = wi.z + wo.z;
    float horizontal2 = x * x + y * y;
    float flat_part = (1.0f - m.specular - m.facets - m.beam) * wo.z / HTS_PI;
    float width2 = max(m.facet_width2, 1.0e-12f);
    float slopes = 0.5f * exp(-horizontal2 / (z * z * width2)) / (HTS_PI * width2) * (horizontal2 + z * z) / (z * z * z);
    float beam = exp(-horizontal2 / m.beam_width2) / (HTS_PI * m.beam_width2) * wo.z;
    return flat_part + m.facets * slopes + m.beam * beam;
}

// A direction drawn from three uniform numbers in [0, 1).
struct HtsDraw {
    vec3 direction;
    float pdf;           // [1/sr]; of the mirror direction its probability; 0 if nothing was drawn
    float weight;        // brdf cosine / pdf [1], of the mirror direction reflectance / pdf
    bool specular;
};

// Density of drawing wo from a diffuse term [1/sr].
float hts_he_pdf(vec3 wi, vec3 wo, float wavelength, float sigma0, float tau, float n, float k, float albedo) {
    if (wi.z <= 0.0f || wo.z <= 0.0f) return 0.0f;
    return hts_mixture_pdf(hts_mixture(wi, wavelength, sigma0, tau, n, k, albedo), wi, wo);
}

HtsDraw hts_he_sample(vec3 wi, vec3 u, float wavelength, float sigma0, float tau, float n, float k, float albedo) {
    HtsDraw d;
    d.direction = vec3(-wi.x, -wi.y, wi.z);
    d.pdf = 0.0f;
    d.weight = 0.0f;
    d.specular = false;
    if (wi.z <= 0.0f) return d;
    HtsMixture m = hts_mixture(wi, wavelength, sigma0, tau, n, k, albedo);
    if (u.x < m.specular) {
        d.specular = true;
        d.pdf = m.specular;
        d.weight = hts_he_specular(wi, wavelength, sigma0, tau, n, k) / d.pdf;
        return d;
    }
    float turn = 2.0f * HTS_PI * u.z;
    float radius = sqrt(-log(1.0f - min(u.y, 0.9999999f)));
    if (u.x < m.specular + m.facets) {
        float qx = radius * sqrt(m.facet_width2) * cos(turn);
        float qy = radius * sqrt(m.facet_width2) * sin(turn);
        float along = 2.0f * (wi.x * qx + wi.y * qy + wi.z) / (1.0f + qx * qx + qy * qy);
        d.direction = vec3(along * qx - wi.x, along * qy - wi.y, along - wi.z);
    } else if (u.x < m.specular + m.facets + m.beam) {
        float x = radius * sqrt(m.beam_width2) * cos(turn) - wi.x;
        float y = radius * sqrt(m.beam_width2) * sin(turn) - wi.y;
        float z2 = 1.0f - x * x - y * y;
        if (z2 <= 0.0f) return d;
        d.direction = vec3(x, y, sqrt(z2));
    } else {
        float sine = sqrt(u.y);
        d.direction = vec3(sine * cos(turn), sine * sin(turn), sqrt(1.0f - u.y));
    }
    if (d.direction.z <= 0.0f) return d;
    d.pdf = hts_mixture_pdf(m, wi, d.direction);
    d.weight = hts_he_brdf(wi, d.direction, wavelength, sigma0, tau, n, k, albedo) * d.direction.z / d.pdf;
    return d;
}
