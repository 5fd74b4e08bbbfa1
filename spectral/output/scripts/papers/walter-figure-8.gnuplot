# Distributions of normals and their shadowing.
set samples 2
set multiplot layout 1,2 margins 0.08,0.975,0.13,0.82 spacing 0.095,0.1
set label 'Normals and shadowing, after Fig. 8 of Walter et al. 2007' \
    at screen 0.015,0.955 left noenhanced font ',18' tc rgb '#111111'
set label 'Beckmann α = 0.2, Phong exponent 48, GGX α = 0.2: Phong is like Beckmann, GGX has a narrower ' . \
    'peak and longer tails.' \
    at screen 0.015,0.9 left noenhanced font ',13' tc rgb '#111111'
set xlabel 'θ_m [°]'
set ylabel 'D [1/sr]'
set xrange [0:40]
set yrange [0:*]
normals = 'figure-8-normals.csv'
plot normals using 1:2 every ::1 with lines lw 2 dt 2 lc rgb '#d55e00' title 'Beckmann', \
     normals using 1:3 every ::1 with lines lw 2 dt 3 lc rgb '#0072b2' title 'Phong', \
     normals using 1:4 every ::1 with lines lw 2.4 lc rgb '#009e73' title 'GGX'
unset label
set xlabel 'θ_v [°]'
set ylabel 'G_1'
set xrange [0:90]
set yrange [0:1.05]
set xtics 15
set key left bottom
shadowing = 'figure-8-shadowing.csv'
plot shadowing using 1:2 every ::1 with lines lw 2 dt 2 lc rgb '#d55e00' title 'Beckmann', \
     shadowing using 1:3 every ::1 with lines lw 2.4 lc rgb '#009e73' title 'GGX'
unset multiplot
