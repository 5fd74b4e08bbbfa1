# How much of explicit surfaces is lit, and lit and seen; a panel per slope.
#   slope[]   of the panels
#   $shares   angle, lit, its standard error, lit and seen, Smith, He et al., heights correlated; an index per
#             panel
set terminal svg size 1000,720 font 'Helvetica,14' background '#ffffff'
set output picture
set label 'How much of a rough surface is lit, and lit and seen' \
    at screen 0.015,0.965 left noenhanced font ',19' tc rgb '#111111'
set label 'Rays on explicit surfaces (dots) against Smith''s functions (lines); seen from the mirror ' . \
    'direction.' \
    at screen 0.015,0.93 left noenhanced font ',13' tc rgb '#111111'
set multiplot layout 2,3 margins 0.075,0.98,0.08,0.86 spacing 0.05,0.1
set xrange [28:88]
set xtics 15
set yrange [0:1.05]
set ytics 0.25
set key at graph 0.03,0.04 left bottom Left reverse samplen 2 font ',13'
do for [i=0:|slope|-1] {
    set title sprintf('σ_0/τ = %.6g', slope[i + 1]) font ',14' offset 0,-0.7
    set ylabel (i % 3 == 0 ? 'share of the surface' : '') offset 1,0
    if (i + 3 >= |slope|) { set xlabel 'angle [°]' offset 0,0.5 }
    plot $shares index i using 1:5 with lines lw 2.2 lc rgb '#e69f00' title 'Smith S_1', \
        $shares index i using 1:6 with lines lw 2.2 lc rgb '#0072b2' title 'S of this model', \
        $shares index i using 1:7 with lines lw 2.2 dt 2 lc rgb '#d55e00' title 'heights correlated', \
        $shares index i using 1:2:3 with yerrorbars pt 7 ps 0.6 lc rgb '#000000' title 'lit', \
        $shares index i using 1:4 with points pt 6 ps 0.7 lc rgb '#000000' title 'lit and seen'
    set key off
    unset label
}
unset multiplot
