# Kirchhoff's integral over explicit surfaces against the closed form, and whether the deviations are those of
# chance.
#   surface[]     names of the cases
#   $ratios       closed form, computed / closed form, standard error / closed form; an index per case
#   $deviations   in standard errors, sorted, and the share of directions below
set terminal svg size 1000,560 font 'Helvetica,14' background '#ffffff'
set output picture
set label 'The Fourier integral of explicit surfaces against the closed form' \
    at screen 0.015,0.96 left noenhanced font ',19' tc rgb '#111111'
set label 'Before shadowing. Each point is a direction; bars are standard errors of the mean.' \
    at screen 0.015,0.915 left noenhanced font ',13' tc rgb '#111111'
set multiplot layout 1,2 margins 0.075,0.975,0.12,0.86 spacing 0.08,0.05
set logscale x
set format x '10^{%L}'
set xlabel 'closed form [1/sr]'
set ylabel 'computed / closed form'
set yrange [0.5:1.6]
set key inside top left Left reverse vertical maxrows 3 samplen 0.8 font ',12'
set arrow from graph 0, first 1 to graph 1, first 1 nohead lc rgb '#888888'
colours = '#0072b2 #56b4e9 #009e73 #e69f00 #d55e00 #aa4499'
plot for [i=1:|surface|] $ratios index i-1 using 1:2:3 with yerrorbars pt 7 ps 0.4 lw 1 \
    lc rgb word(colours, (i - 1) % 6 + 1) title surface[i]
unset label
unset arrow
unset logscale
set format x '%g'
set key top left Left reverse at graph 0.03,0.97
set xrange [-4:4]
set yrange [0:1]
set xlabel '(computed - closed form) / standard error'
set ylabel 'share of directions below'
plot norm(x) with lines lw 2 lc rgb '#888888' title 'chance', \
    $deviations using 1:2 with steps lw 2 lc rgb '#000000' title 'found'
unset multiplot
