# BRDF over the distance from the mirror direction in sines, both on logarithmic axes.
#   title                                  text
#   data                                   CSV with |beta - beta_0| in column 4 and the BRDF in column 7
#   theta_i[], first[], middle[], last[]   per curve: angle of incidence, the first record beyond the mirror
#                                          direction and within, and the last
#   top                                    end of the axis, a power of ten
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set xlabel '|β − β_0| = |sin θ_r − sin θ_i|, in the plane of incidence'
set ylabel 'BRDF [1/sr]'
set xrange [*:2]
set yrange [top*1e-8:top]
set label title at screen 0.03,0.955 left noenhanced tc rgb '#111111' font ',17'
set label 'solid: beyond the mirror direction, towards the horizon; dashed: on the side of the normal and of the light' \
    at screen 0.03,0.905 left noenhanced tc rgb '#444444' font ',13'
set lmargin at screen 0.12
set rmargin at screen 0.97
set tmargin at screen 0.87
set bmargin at screen 0.13
set key bottom left samplen 2.5 opaque
plot for [i=1:|theta_i|] data every ::first[i]::(middle[i]-1) using 4:7 with lines lw 2.4 lc rgb curve_colour(i, |theta_i|) \
        title sprintf('θ_i = %.15g°', theta_i[i]), \
    for [i=1:|theta_i|] data every ::middle[i]::last[i] using 4:7 with lines lw 2.4 dt (8,5) \
        lc rgb curve_colour(i, |theta_i|) notitle
