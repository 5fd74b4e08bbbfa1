# Albedo of the form with an exponent of Kurt et al. 2010, a panel per width of the slopes.
#   width[], data[]   of the panels, data a CSV file
#   curve[]           names of the columns after the first
set multiplot layout 1,3 margins 0.085,0.98,0.2,0.82 spacing 0.04,0.1
set label 'Albedo of the form with the exponent α, after Fig. 3 of Kurt et al. 2010' \
    at screen 0.02,0.955 left noenhanced font ',18' tc rgb '#111111'
set label 'F = 1. Every curve with α > 0 grows without bound at last, like (cos θ)^-α.' \
    at screen 0.02,0.905 left noenhanced font ',13' tc rgb '#111111'
set xlabel 'angle of incidence [°]'
set xrange [0:90]
set xtics 15
set yrange [0:1.5]
set ytics 0.25
set key at graph 0.04,0.46 left top reverse Left samplen 1.5
set ylabel 'albedo' offset 2,0
# the reflectance that no passive surface exceeds
set arrow from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#888888'
colours = '#0072b2 #56b4e9 #009e73 #e69f00 #d55e00 #aa4499'
do for [k=1:|width|] {
    if (k == 2) {
        unset key
        unset label
        unset ylabel
        set format y ''
    }
    set label 9 sprintf('m = %.15g', width[k]) at graph 0.05,0.94 font ',15'
    plot for [i=1:|curve|] data[k] using 1:i+1 every ::1 with lines lw 2.4 lc rgb word(colours, i) \
        title curve[i]
}
unset multiplot
