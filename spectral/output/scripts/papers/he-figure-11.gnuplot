# BRDF against the view angle, as in Fig. 11 of He et al. 1991.
#   title, caption               texts
#   data                         CSV with the view angle in column 2 and the BRDF in column 6
#   theta_i[], first[], last[]   per curve: angle of incidence and its records
set margins 11,4,5,6
set label title at screen 0.03,0.95 left noenhanced font ',17' tc rgb '#111111'
set label caption at screen 0.03,0.9 left noenhanced font ',13' tc rgb '#111111'
set logscale y
set format y '10^{%T}'
set xlabel 'view angle [°], the mirror side positive'
set ylabel 'BRDF [1/sr]' offset 1,0
set xrange [-90:90]
set xtics 15
set yrange [0.01:1000]
set key at graph 0.03,0.97 left top reverse Left
plot for [i=1:|theta_i|] data every ::first[i]::last[i] using 2:6 with lines lw 2.4 lc rgb angle_colour(theta_i[i]) \
    title sprintf('θ_i = %.15g°', theta_i[i])
