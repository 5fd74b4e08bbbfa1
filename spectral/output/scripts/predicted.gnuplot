# Measured dots, a fit and predictions, a panel per angle of incidence.
#   surface      text
#   panel[]      titles
#   line[]       what the columns of $lines are: the fit first
#   $points      view [deg], measured; an index per panel
#   $lines       view [deg], each line; an index per panel
columns = |panel| == 1 ? 1 : 2
rows = (|panel| + columns - 1) / columns
pixels = 170 + 300. * rows
set terminal svg size 1000,int(pixels) font 'Helvetica,15' background '#ffffff'
set output picture
set label surface at screen 0.03,1-22/pixels left noenhanced font ',17' tc rgb '#111111'
set multiplot
set logscale y
set format y '1e%T'
set xtics 30
unset mytics
set xrange [-90:90]
set key at screen 0.99,1-34/pixels right top vertical samplen 2 font ',12' noenhanced
set bmargin 3
set tmargin 1.5
set lmargin 7
set rmargin 1
width = 0.97 / columns
height = (1 - 145 / pixels) / rows
do for [i=0:|panel|-1] {
    set size six(width),six(height)
    set origin six(0.015 + width * (i % columns)),six(1 - 135 / pixels - height * (i / columns + 1))
    set xlabel (i + columns >= |panel| ? 'view [deg], mirror side > 0' : '') noenhanced font ',12' offset 0,0.7
    set ylabel (i % columns == 0 ? 'BRDF [1/sr]' : '') noenhanced font ',12' offset 1.6,0
    set title panel[i + 1] offset 0,-0.7 font ',13'
    plot for [k=1:|line|] $lines index i using 1:(column(k + 1)) with lines lw (k == 1 ? 3 : 2) \
            dt k lc rgb word(curve_colours, k == 1 ? 5 : k - 1) title line[k], \
        $points index i using 1:2 with points pt 7 ps 0.45 lc rgb '#777777' title 'measured'
    set key off
    unset label
}
unset multiplot
