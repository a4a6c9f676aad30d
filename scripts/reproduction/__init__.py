"""The tables and figures of Qian et al. (2020), run under both contact laws and judged claim by claim.

Source of the claims: Qian, Qin, Yan, Zhang, Mech. Mach. Theory 145 (2020) 103717.
"""
