// What is saved here is listed again where it is restored.
void Filter::save(BlobWriter& out) const { out.put(mean_); }
void Filter::restore(BlobReader& in) { mean_ = in.get<double>(); }
