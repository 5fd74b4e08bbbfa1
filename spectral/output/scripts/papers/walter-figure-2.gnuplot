# Light through ground glass.
#   theta_i[], refracted[]   angles of incidence, and where a smooth surface would refract the light
set samples 2
set margins 9,3,4,6
set label 'Light through ground glass, after Fig. 2 of Walter et al. 2007' \
    at screen 0.015,0.955 left noenhanced font ',18' tc rgb '#111111'
set label 'Theory: GGX, α = 0.394, index 1.51. Dashed: where a smooth surface would refract the light.' \
    at screen 0.015,0.9 left noenhanced font ',13' tc rgb '#111111'
set xlabel 'transmitted angle θ_o [°]'
set ylabel 'f_t |o·n| [1/sr]'
set xrange [-30:90]
set xtics 30
set yrange [0:*]
do for [i=1:|theta_i|] {
    set arrow from refracted[i], graph 0 to refracted[i], graph 1 nohead dt 2 lw 1.4 lc rgb angle_colour(theta_i[i])
}
plot for [i=1:|theta_i|] 'figure-2.csv' using 1:2*i+1 every ::1 with lines lw 2.4 lc rgb angle_colour(theta_i[i]) \
    title sprintf('θ_i = %.15g°', theta_i[i])
