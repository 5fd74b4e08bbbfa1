# Where the model of Kurt et al. 2010 conserves energy.
#   curve[]   names of the columns after the first, limits of the angle of incidence
set margins 9,17,4,5
set label 'Where the model of Kurt et al. 2010 conserves energy' \
    at screen 0.02,0.955 left noenhanced font ',18' tc rgb '#111111'
set label 'F = 1. Below a curve the albedo is at most 1 up to that angle of incidence.' \
    at screen 0.02,0.905 left noenhanced font ',13' tc rgb '#111111'
set logscale x
set xrange [0.02:2]
set yrange [0:1]
set xlabel 'width m of the slopes'
set ylabel 'exponent α'
set key at graph 1.02,0.95 left top reverse Left
set xtics (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2)
colours = '#0072b2 #56b4e9 #009e73 #e69f00 #d55e00 #aa4499'
plot 'plausible-alpha.csv' using 1:4 every ::1 with filledcurves x1 fs solid 0.12 noborder lc rgb '#009e73' \
    notitle, \
     for [i=1:|curve|] 'plausible-alpha.csv' using 1:i+1 every ::1 with lines lw 2.4 lc rgb word(colours, i) \
         title curve[i]
