# What every script begins with: CSV in, quiet axes and grid. Colours are those of Okabe and Ito or of
# viridis, for all kinds of colour vision; the canvas is white, and the program adds a dark form.
set datafile separator comma
set border 3 lc rgb '#666666'
set tics nomirror textcolor rgb '#333333'
set grid lc rgb '#e4e4e4' lw 0.6
set pointintervalbox 0
# A place on the page in six digits, as the program once printed them: pictures stay the same bytes.
six(place) = real(sprintf('%.6g', place))
# An angle of incidence has one colour in all pictures: steps of 15 degrees, unless two of a picture share one.
angle_colours = '#000000 #0072b2 #d55e00 #009e73 #aa4499 #e69f00 #56b4e9'
angle_colour(degrees) = word(angle_colours, int(floor(abs(degrees) / 15. + 0.5)) + 1)
curve_colours = '#0072b2 #d55e00 #009e73 #aa4499 #000000 #e69f00 #56b4e9 #777777'
alike(i, j) = angle_colour(theta_i[i]) eq angle_colour(theta_i[j])
shared_colours(count) = (sum [i=1:count] (sum [j=1:i-1] alike(i, j)))
# Of the i-th of so many curves, where theta_i[] has the angles of all.
curve_colour(i, count) = shared_colours(count) == 0 ? angle_colour(theta_i[i]) : \
    word(curve_colours, (i - 1) % 8 + 1)
