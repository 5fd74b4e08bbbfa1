# A measured surface: its first map, how heights are distributed, spectrum and autocorrelation with fits.
#   name                  text
#   rms, lowest, highest      of heights [um], frequencies that the maps know [1/um]
#   width, height_um      of the field; length: where the autocorrelation is 1/e; farthest: its last distance
#   fit[]                 descriptions, columns 4 … of radial-spectrum.csv, 3 … of autocorrelation.csv
#   $map                  x, y, height;     $heights   height/rms, density, Gaussian
set terminal svg size 1000,860 font 'Helvetica,14' background '#ffffff'
set output picture
set label 'Measured surface: '.name at screen 0.015,0.972 left noenhanced font ',19' tc rgb '#111111'
set label sprintf('rms %.4g µm; periods %.3g to %.3g µm are known, what the curves say of others is extrapolated.', \
    rms, 1./highest, 1./lowest) at screen 0.015,0.943 left noenhanced font ',13' tc rgb '#111111'
array colour[4] = ['#0072b2','#009e73','#d55e00','#cc79a7']
set multiplot
set origin 0,0.47
set size 0.5,0.45
set title 'heights of the first map [µm]' font ',13' offset 0,-0.6
set xrange [0:width]
set yrange [0:height_um]
set size ratio -1
set xlabel 'x [µm]' offset 0,0.5
set ylabel 'y [µm]' offset 1,0
set cbrange [-3*rms:3*rms]
set palette defined (0 '#08306b', 1 '#6baed6', 2 '#f4f4f4', 3 '#fd8d3c', 4 '#7f2704')
unset grid
plot $map using 1:2:3 with image notitle
set size noratio
set size 0.5,0.45
set origin 0.5,0.47
set grid
set title 'how heights are distributed' font ',13' offset 0,-0.6
set xrange [-5:5]
set yrange [1e-5:1]
set logscale y
set format y '10^{%T}'
set xlabel 'height/rms' offset 0,0.5
set ylabel 'density' offset 1,0
set key bottom center samplen 1.6 font ',12'
plot $heights using 1:2 with points pt 7 ps 0.5 lc rgb '#000000' title 'measured', \
    $heights using 1:3 with lines lw 2.2 lc rgb '#0072b2' title 'Gaussian'
set origin 0,0.01
set size 0.5,0.45
set title 'power spectrum S_2 [µm⁴]' font ',13' offset 0,-0.6
set logscale x
set xrange [lowest/2:highest*2]
set yrange [*:*]
stats 'radial-spectrum.csv' using 1:3 skip 1 nooutput prefix 'S'
set yrange [S_min_y/10:S_max_y*10]
set xlabel 'frequency [1/µm]' offset 0,0.5
unset ylabel
set arrow 1 from lowest,graph 0 to lowest,graph 1 nohead dt 3 lc rgb '#666666'
set arrow 2 from highest,graph 0 to highest,graph 1 nohead dt 3 lc rgb '#666666'
set key bottom left
plot 'radial-spectrum.csv' using 1:3 skip 1 with points pt 7 ps 0.5 lc rgb '#000000' title 'measured', \
    for [i=1:|fit|] 'radial-spectrum.csv' using 1:(column(3+i)) skip 1 with lines lw 2 lc rgb colour[i] title fit[i]
unset arrow
set origin 0.5,0.01
set size 0.5,0.45
set title 'autocorrelation' font ',13' offset 0,-0.6
unset logscale
set format y '%g'
set xrange [0:(length > 0 && 6*length < farthest ? 6*length : farthest)]
set yrange [-0.3:1]
set xlabel 'distance [µm]' offset 0,0.5
set key top right
plot 'autocorrelation.csv' using 1:2 skip 1 with points pt 7 ps 0.4 lc rgb '#000000' title 'measured', \
    for [i=1:|fit|] 'autocorrelation.csv' using 1:(column(2+i)) skip 1 with lines lw 2 lc rgb colour[i] title fit[i]
unset multiplot
