#!/bin/sh
# Prints how far three closed forms are from exact scattering, region by region [dB], from a map of `hts truth`:
#     docs/distances.sh validation/scattering/data/moment-method-map.csv [te | tm]      unpolarised light unless told
exec awk -v polarisation="${2:+${2}_}" '
BEGIN {
    FS = ","
    split("this model|Kirchhoff|correlated Smith", titles, "|")
    split("he_torrance_|kirchhoff_|smith_", columns, "|")
    last = split("gentle, tau >= 2 lambda|gentle, tau = lambda|gentle, tau = 0.7 lambda|" \
                 "gentle, tau = 0.35 lambda|steep, tau > lambda/2|all", regions, "|")
}
/^#/ { next }
!named { for (i = 1; i <= NF; ++i) place[$i] = i; named = 1; next }
{
    sigma0 = $place["sigma0_over_lambda"]; tau = $place["tau_over_lambda"]; theta = $place["theta_i_deg"]
    gentle = sigma0 / tau <= 0.25 && theta <= 60
    if (gentle && tau >= 2) add(1)
    if (gentle && tau == 1) add(2)
    if (gentle && tau == 0.7) add(3)
    if (gentle && tau == 0.35) add(4)
    if (sigma0 / tau >= 0.25 && theta == 60 && tau > 0.5) add(5)
    add(last)
}
END {
    printf "%-25s%5s", "least, median, greatest", "cases"
    for (m = 1; m <= 3; ++m) printf "%17s", titles[m]
    print ""
    for (region = 1; region <= last; ++region) {
        if (!count[region]) continue
        printf "%-25s%5d", regions[region], count[region]
        for (m = 1; m <= 3; ++m) {
            sort(m, region)
            printf "  %5.2f%5.2f%5.2f", value[region, m, 1], median(m, region), value[region, m, count[region]]
        }
        print ""
    }
    printf "%-47s%17s%17s\n", "cases where it is nearer than this model", nearer[2], nearer[3]
}
function add(region,    m) {
    ++count[region]
    for (m = 1; m <= 3; ++m) value[region, m, count[region]] = distance(m)
    for (m = 2; region == last && m <= 3; ++m) nearer[m] += distance(m) < distance(1)
}
function distance(m) {
    return $place[columns[m] polarisation "db"] + 0
}
function sort(m, region,    i, j, x) {
    for (i = 2; i <= count[region]; ++i) {
        x = value[region, m, i]
        for (j = i; j > 1 && value[region, m, j - 1] > x; --j) value[region, m, j] = value[region, m, j - 1]
        value[region, m, j] = x
    }
}
function median(m, region,    n) {
    n = count[region]
    return (value[region, m, int((n + 1) / 2)] + value[region, m, int(n / 2) + 1]) / 2
}' "$1"
